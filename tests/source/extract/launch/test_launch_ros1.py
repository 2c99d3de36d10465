"""Launch files of ROS 1, worked out by hand and held against roslaunch itself."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
import yaml

from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
from roslens.source.extract.symbolic.condition import as_written

ROOT = Path(__file__).parents[3] / "fixtures" / "extract" / "launch_ros1"
CASES = sorted(path.name for path in (ROOT / "robot" / "launch").iterdir())
FILES = FolderFiles(ROOT, {"robot": "robot"})
PROBE = """
import json, sys
from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader
found = ROSLaunchConfig()
XmlLoader(resolve_anon=False).load(sys.argv[1], found, argv=sys.argv[2:], verbose=False)
nodes = [
    [one.package, one.type, one.namespace, one.name, one.args.split(), [list(pair) for pair in one.remap_args]]
    for one in found.nodes + found.tests
]
print(json.dumps([nodes, {name: one.value for name, one in found.params.items()}]))
"""


def evaluated(name, **arguments):
    return evaluate_ros1(f"robot/launch/{name}", FILES, arguments)


class Written:
    """Files that are written in the test."""

    def __init__(self, files):
        self.files = files

    @classmethod
    def of(cls, content):
        return cls({"a.launch": content.encode()})

    def package(self, name):
        return name if any(path.startswith(f"{name}/") for path in self.files) else None

    def content(self, path):
        return self.files.get(path)


def test_scopes():
    nodes = {str(one.name): one for one in evaluated("scopes.launch").nodes}
    assert {name: str(one.namespace) for name, one in nodes.items()} == {
        "filter": "/",
        "controller": "/arm",
        "hand": "/abs/left",
        "base": "/wheels",
    }
    assert [(str(one.source), str(one.target)) for one in nodes["hand"].remaps] == [
        ("scan", "front/scan"),
        ("joints", "/joint_states"),
        ("~grip", "grip"),
    ]
    assert [str(word) for word in nodes["controller"].arguments] == ["--fast", "1.5"]
    assert [str(one.source) for one in nodes["base"].remaps] == ["scan"]
    assert nodes["hand"].evidence.line == 8


def test_arguments_conditions_and_includes():
    whole = evaluated("arguments.launch")
    assert [str(one.name) for one in whole.nodes] == ["r2_lidar", "chosen", "included_other", "included_r2"]
    assert [(one.name, str(one.default)) for one in whole.arguments] == [
        ("robot", "r2"),
        ("lidar", "true"),
        ("kind", "r2_kind"),
    ]
    assert whole.included == ("robot/launch/included.launch",)
    assert whole.unresolved == ()
    assert [str(one.name) for one in evaluated("arguments.launch", lidar="0", robot="x").nodes][:2] == [
        "sonar",
        "included_other",
    ]


def test_nodelets_are_told_from_programs():
    nodes = evaluated("nodelets.launch").nodes
    assert [(one.kind, str(one.plugin), str(one.container)) for one in nodes] == [
        ("container", "", ""),
        ("nodelet", "image_proc/rectify", "manager"),
        ("nodelet", "image_proc/debayer", ""),
        ("test", "", ""),
    ]


def test_what_depends_on_the_machine_is_a_hole():
    files = Written.of(
        '<launch><arg name="x" default="$(env ROBOT)"/>'
        '<node if="$(arg x)" pkg="a" type="b" name="$(anon n)" ns="$(optenv NS left)"/></launch>'
    )
    (node,) = evaluate_ros1("a.launch", files).nodes
    assert as_written(node.conditions) == ("$(arg x)",)
    assert node.anonymous
    assert node.namespace.usual == "/left"
    (node,) = evaluate_ros1("a.launch", files, environment={"ROBOT": "true"}).nodes
    assert as_written(node.conditions) == ()


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("<launch><node pkg='a' type='b' name='$(arg x)'/></launch>", "there is no argument 'x'"),
        ("<launch><arg name='x'/><node pkg='a' type='b' name='n$(arg x)'/></launch>", "required, but not given"),
        ("<launch><node type='b' name='n'/></launch>", "no 'pkg'"),
        ("<launch><include file='a.launch'/></launch>", "includes itself: a.launch > a.launch"),
        ("<launch><include file='$(find gone)/x.launch'/></launch>", "package gone, which is not in the workspace"),
        ("<launch><include file='gone.launch'/></launch>", "no such file"),
        ("<launch><node if='maybe' pkg='a' type='b' name='n'/></launch>", "'maybe' is not a condition"),
        ("<launch><param name='x'/></launch>", "no value"),
        ("<launch><param name='x' value='$(eval __import__(1))'/></launch>", "double underscores"),
        ("<launch><param name='x' value='$(find a'/></launch>", "never closed"),
        ("<launch><param name='x' value='$(nothing a)'/></launch>", "'nothing' is not a substitution"),
        ("<launch><rosparam>a: [1</rosparam></launch>", "expected"),
        ("<launch><executable cmd='ls'/></launch>", "not an element of roslaunch"),
        ("<robot/>", "expected <launch>"),
        ("<launch><node", "expected"),
    ],
)
def test_what_roslaunch_refuses_is_unresolved_with_its_place(content, reason):
    files = Written.of(content.replace("</launch>", "<node pkg='a' type='b' name='last'/></launch>"))
    whole = evaluate_ros1("a.launch", files)
    assert reason in " ".join(one.reason for one in whole.unresolved)
    assert all(one.evidence.path == "a.launch" for one in whole.unresolved)
    if content.endswith("</launch>"):
        assert str(whole.nodes[-1].name) == "last"


@pytest.mark.parametrize(
    ("content", "opens"),
    [
        ("<launch><include file='gone.launch'/></launch>", True),
        ("<launch><include file='$(find gone)/x.launch'/></launch>", True),
        ("<launch><include file='$(arg gone)'/></launch>", True),
        ("<launch><group ns='$(arg gone)'><node pkg='a' type='b' name='n'/></group></launch>", True),
        ("<launch><param name='x'/></launch>", False),
        ("<launch><rosparam file='gone.yaml'/></launch>", False),
    ],
)
def test_what_may_start_further_nodes_is_told_apart(content, opens):
    assert [one.opens for one in evaluate_ros1("a.launch", Written.of(content)).unresolved] == [opens]


def test_includes_without_end_stop():
    files = Written.of("<launch>" + "<include file='b.launch'/>" * 20 + "</launch>")
    files.files["b.launch"] = b"<launch>" + b"<include file='c.launch'/>" * 20 + b"</launch>"
    files.files["c.launch"] = b"<launch><node pkg='a' type='b' name='n'/></launch>"
    whole = evaluate_ros1("a.launch", files)
    assert 0 < len(whole.nodes) < 200
    assert "more than 200 files" in whole.unresolved[0].reason


def comparable(whole):
    nodes = [
        [str(one.package), str(one.executable), str(one.namespace).rstrip("/") + "/", str(one.name),
         [str(word) for word in one.arguments], [[str(pair.source), str(pair.target)] for pair in one.remaps]]
        for one in whole.nodes
    ]  # fmt: skip
    settings = {str(one.name): plain(one) for one in whole.settings}
    for node in whole.nodes:
        before = f"{str(node.namespace).rstrip('/')}/{node.name}/"
        settings |= {str(one.name).replace("~", before): plain(one) for one in node.settings}
    return sorted(nodes, key=by_name), settings


def by_name(node):
    return node[2], node[3]


def plain(setting):
    text = str(setting.value)
    return text if setting.type == "string" else yaml.safe_load(text)


def flat(prefix, values):
    for name, value in values.items():
        if isinstance(value, dict):
            yield from flat(f"{prefix}{name}/", value)
        else:
            yield f"{prefix}{name}", value


@pytest.mark.real
@pytest.mark.parametrize("name", [one for one in CASES if one != "included.launch"])
def test_roslaunch_says_the_same(name):
    if not shutil.which("roslaunch"):
        pytest.skip("roslaunch is not installed: apt-get install ros-base")
    path = ROOT / "robot" / "launch" / name
    environment = {**os.environ, "ROS_PACKAGE_PATH": str(ROOT), "PYTHONPATH": ""}
    ran = subprocess.run(
        ["/usr/bin/python3", "-c", PROBE, str(path)], capture_output=True, text=True, env=environment, timeout=60,
        check=True,
    )  # fmt: skip
    nodes, parameters = json.loads(ran.stdout)
    for node in nodes:
        node[4] = [word.replace(f"{ROOT}/", "") for word in node[4]]
    found, settings = comparable(evaluated(name))
    assert found == sorted(nodes, key=by_name)
    assert settings == dict(flat("", parameters))


def test_what_is_set_after_a_node_holds_over_its_own():
    files = Written.of(
        "<launch><param name='/n/a' value='0'/><node pkg='p' type='t' name='n'><param name='a' value='1'/></node>"
        "<param name='/n/a' value='2'/><param name='/nn/a' value='3'/></launch>"
    )
    (node,) = evaluate_ros1("a.launch", files).nodes
    assert [(str(one.name), str(one.value)) for one in node.settings] == [("~a", "1"), ("/n/a", "2")]


def test_arguments_of_the_command_line_need_no_declaration():
    files = Written.of("<launch><node pkg='p' type='t' name='$(arg who)'/></launch>")
    assert [str(one.name) for one in evaluate_ros1("a.launch", files, {"who": "n"}).nodes] == ["n"]


def test_included_nodes_have_the_remappings_and_parameters_around_the_include():
    files = Written.of(
        "<launch><remap from='scan' to='front'/><param name='~rate' value='5'/>"
        "<group><remap from='odom' to='wheels'/><include file='b.launch'/></group><include file='b.launch' ns='two'/>"
        "</launch>"
    )
    files.files["b.launch"] = b"<launch><node pkg='p' type='t' name='n'/></launch>"
    first, second = evaluate_ros1("a.launch", files).nodes
    assert [(str(one.source), str(one.target)) for one in first.remaps] == [("scan", "front"), ("odom", "wheels")]
    assert [(str(one.source), str(one.target)) for one in second.remaps] == [("scan", "front")]
    assert [[(str(one.name), str(one.value)) for one in node.settings] for node in (first, second)] == [
        [("~rate", "5")],
        [("~rate", "5")],
    ]


def test_parameters_hold_over_files_of_them_wherever_they_stand():
    files = Written.of(
        "<launch><param name='~a' value='2'/><node pkg='p' type='t' name='n'>"
        "<param name='b' value='3'/><rosparam>{a: 0, b: 0, c: 0, /d: 0}</rosparam></node></launch>"
    )
    whole = evaluate_ros1("a.launch", files)
    assert {str(one.name): str(one.value) for one in whole.nodes[0].settings} == {"~a": "2", "~b": "3", "~c": "0"}
    assert [(str(one.name), str(one.value)) for one in whole.settings] == [("/d", "0")]


def test_the_later_remapping_of_a_name_takes_the_place_of_the_first():
    files = Written.of(
        "<launch><remap from='a' to='x'/><remap from='b' to='y'/>"
        "<node pkg='p' type='t' name='n'><remap from='a' to='z'/></node></launch>"
    )
    (node,) = evaluate_ros1("a.launch", files).nodes
    assert [(str(one.source), str(one.target)) for one in node.remaps] == [("b", "y"), ("a", "z")]


def test_arguments_of_a_group_end_with_it():
    files = Written.of(
        "<launch><group><arg name='x' value='1'/></group><group><arg name='x' value='2'/>"
        "<param name='inside' value='$(arg x)'/></group><param name='outside' value='$(arg x)'/></launch>"
    )
    whole = evaluate_ros1("a.launch", files)
    assert [(str(one.name), str(one.value)) for one in whole.settings] == [("/inside", "2")]
    assert "no argument 'x'" in whole.unresolved[0].reason


def test_substitutions_are_made_before_arguments_are_split():
    files = Written.of(
        "<launch><arg name='more' value='--fast scan:=front'/>"
        "<node pkg='p' type='t' name='n' args='$(arg more) \"two words\" $(env X)y'/></launch>"
    )
    (node,) = evaluate_ros1("a.launch", files).nodes
    assert [one.pattern for one in node.arguments] == ["--fast", "scan:=front", "two words", "*y"]


def test_what_the_machine_decides_is_in_doubt():
    files = Written.of(
        "<launch><arg name='x' default='a'/><group><arg name='y' value='1' if='$(optenv SIM 0)'/>"
        "<arg name='z' value='2' unless='$(optenv SIM 0)'/>"
        "<node pkg='p' type='t' name='n'><remap from='scan' to='other' if='$(env SIM)'/>"
        "<param name='y' value='$(arg y)'/><param name='z' value='$(arg z)'/>"
        "<param name='w' value='3' if='$(optenv SIM 1)'/></node></group>"
        "<group if='$(env SIM)'><param name='s' value='4'/>"
        "<node pkg='p' type='t' name='m'><param name='u' value='5'/></node></group></launch>"
    )
    whole = evaluate_ros1("a.launch", files)
    first, second = whole.nodes
    (one,) = first.remaps
    assert (one.target.pattern, one.target.holes[0].reason) == ("*", "other, if $(env SIM)")
    values = {str(one.name): one.value for one in (*first.settings, *second.settings, *whole.settings)}
    assert {name: (one.pattern, one.usual) for name, one in values.items()} == {
        "~y": ("*", None),
        "~z": ("*", "2"),
        "~w": ("*", "3"),
        "~u": ("5", "5"),
        "/s": ("*", None),
    }


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("<launch><group ns=''/></launch>", "its namespace is empty"),
        ("<launch><arg name='x' value='1'/><arg name='x' value='1'/></launch>", "declared before"),
        ("<launch><arg name='x' value='1' default='1'/></launch>", "a value and a default"),
        ("<launch><group if='1' unless='0'/></launch>", "both `if` and `unless` are given"),
        ("<launch><param name='x' value='1' command='ls'/></launch>", "value and command are given"),
        ("<launch><param name='x' value='a' type='int'/></launch>", "'a' is not of the type int"),
        ("<launch><remap from='a b' to='c'/></launch>", "'a b' is not a valid ROS name"),
        ("<launch><remap from='' to='c'/></launch>", "'' is not a valid ROS name"),
        ("<launch><rosparam command='drop' param='x'/></launch>", "not a command of rosparam"),
        ("<launch><rosparam>5</rosparam></launch>", "a value without a name"),
        ("<launch><rosparam subst_value='1'>a: 1</rosparam></launch>", "neither true nor false"),
        ("<launch><node pkg='p' type='t' name='a/b'/></launch>", "has a `/`"),
        ("<launch><node pkg='p' type='t' name='n'><group/></node></launch>", "not an element of a node"),
        ("<launch><include file='b.launch'><arg name='gone' value='1'/></include></launch>", "does not declare"),
        ("<launch><include file='b.launch'><arg name='x'/></include></launch>", "has no value"),
    ],
)
def test_mistakes_that_roslaunch_refuses(content, reason):
    files = Written.of(content)
    files.files["b.launch"] = b"<launch><arg name='x' default='1'/></launch>"
    assert reason in " ".join(one.reason for one in evaluate_ros1("a.launch", files).unresolved)
