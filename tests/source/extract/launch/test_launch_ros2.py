"""Launch files of ROS 2: the same robot in each of the three formats, and what cannot be evaluated."""

from pathlib import Path

import pytest

from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
from roslens.source.extract.launch.ros2_names import full_name, within
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import Text

ROOT = Path(__file__).parents[3] / "fixtures" / "extract" / "launch_ros2"
FILES = FolderFiles(ROOT, {"robot": "robot"})
FORMATS = ("xml", "yaml", "py")


class Written:
    """Files that are written in the test."""

    def __init__(self, **files):
        self.files = {name.replace("_", "."): content.encode() for name, content in files.items()}

    def package(self, name):
        return None

    def content(self, path):
        return self.files.get(path)


def told(node):
    return (
        node.kind,
        str(full_name(node)),
        f"{node.package}/{node.executable or node.plugin}",
        str(node.container),
        {f"{one.node}{' ' * bool(one.node)}{one.name}": str(one.value) for one in node.settings},
        {str(one.source): str(one.target) for one in node.remaps},
        as_written(node.conditions),
    )


def python(body, before=""):
    return f"""
import os, random
from launch import *
from launch.actions import *
from launch.conditions import *
from launch.substitutions import *
from launch_ros.actions import Node
{before}
def generate_launch_description():
    {body}
""".replace("import *", "import LaunchDescription, DeclareLaunchArgument, OpaqueFunction, LaunchConfiguration, "
            "IfCondition, EnvironmentVariable, RegisterEventHandler, OnProcessExit, GroupAction, "
            "IncludeLaunchDescription, PythonExpression, SetEnvironmentVariable")  # fmt: skip


@pytest.mark.parametrize("extension", FORMATS)
def test_a_whole_robot(extension):
    whole = evaluate_ros2(f"robot/launch/whole.launch.{extension}", FILES)
    sim, odom = {"use_sim_time": "true" if extension != "py" else "True"}, {"odom": "odometry"}
    open_condition = "environment(OPEN)" if extension == "py" else "$(env OPEN)"
    assert [told(node) for node in whole.nodes] == [
        ("node", "/controller", "moving/controller", "",
         {"/** use_sim_time": "false", "/controller gains.p": "1.5", "/controller gains.i": "0", "limits.speed": "2.5"},
         {"cmd": "/r2/cmd_vel"}, ()),
        ("node", "/r2/front/r2_r2", "laser/driver", "", sim, odom, ()),
        ("node", "/r2/open", "maybe/node", "", sim, odom, (open_condition,)),
        ("container", "/box/container", "rclcpp_components/component_container", "", {}, {}, ()),
        ("component", "/rectify", "image/image::Rectify", "/box/container", {"depth": "5"}, {"image": "camera/image"},
         ()),
        ("component", "/crop", "image/image::Crop", "/box/container", {}, {}, ()),
        ("node", "/base", "moving/base", "", {"speed": "0.5"}, {}, ()),
        ("process", "", "/rviz2", "", {}, {}, ()),
    ]  # fmt: skip
    assert [(one.name, str(one.default), one.choices) for one in whole.arguments] == [
        ("robot", "r2", ("r2", "r3")),
        ("lidar", "true", ()),
    ]
    assert [str(word) for word in whole.nodes[0].arguments] == ["--fast", "1.5"]
    assert whole.included == ("robot/launch/included.launch.py",)
    assert whole.unresolved == ()


@pytest.mark.parametrize("extension", FORMATS)
def test_arguments_decide(extension):
    given = {"robot": "r3", "lidar": "false"}
    whole = evaluate_ros2(f"robot/launch/whole.launch.{extension}", FILES, given, {"OPEN": "0"})
    names = [str(full_name(node)) for node in whole.nodes]
    assert names[:3] == ["/controller", "/r3/sonar", "/box/container"]
    assert whole.nodes[0].remaps[0].target == Text.of("/r3/cmd_vel")


def test_both_ways_of_what_is_unknown_keep_their_condition():
    files = Written(
        a_py=python(
            "nodes = [Node(package='a', executable='always', name='x')]\n"
            "    if os.path.exists('/etc/robot'):\n"
            "        nodes.append(Node(package='a', executable='there', name='y'))\n"
            "    else:\n"
            "        nodes.append(Node(package='a', executable='gone', name='z'))\n"
            "    if random.random() > 0.5:\n"
            "        return LaunchDescription(nodes[:0])\n"
            "    return LaunchDescription(nodes)"
        )
    )
    whole = evaluate_ros2("a.py", files)
    assert [(str(node.executable), as_written(node.conditions)) for node in whole.nodes] == [
        ("always", ("not random.random() > 0.5",)),
        ("there", ("not random.random() > 0.5", "os.path.exists('/etc/robot')")),
        ("gone", ("not random.random() > 0.5", "not os.path.exists('/etc/robot')")),
    ]


def test_loops_functions_and_events():
    files = Written(
        a_py=python(
            "first = [robot(index) for index in range(2)]\n"
            "    event = RegisterEventHandler(OnProcessExit(target_action=first[0], on_exit=[robot('last')]))\n"
            "    for each in os.listdir('/robots'):\n"
            "        first.append(robot(each))\n"
            "    return LaunchDescription([*first, event])",
            "def robot(n, kind='wheeled'):\n    return Node(package=kind, executable='node', name=f'robot{n}')\n",
        )
    )
    whole = evaluate_ros2("a.py", files)
    assert [(node.name.pattern, as_written(node.conditions)) for node in whole.nodes] == [
        ("robot0", ()),
        ("robot1", ()),
        ("robot*", ("there is any of os.listdir('/robots')",)),
        ("robotlast", ("when a process ends",)),
    ]


@pytest.mark.parametrize(
    ("files", "reason"),
    [
        ({"a_py": python("while True:\n        pass")}, "too many steps"),
        ({"a_py": python("return forever()", "def forever():\n    return forever()\n")}, "unknown what it starts"),
        ({"a_py": python("return LaunchDescription(read_config())")}, "unknown what it starts"),
        (
            {"a_py": python("return LaunchDescription([IncludeLaunchDescription('a.py')])")},
            "includes itself: a.py > a.py",
        ),
        ({"a_py": python("return LaunchDescription([IncludeLaunchDescription('gone.py')])")}, "no such file"),
        ({"a_py": "x = 1"}, "expected a launch file that defines it"),
        ({"a_py": "def generate_launch_description(:"}, "expected Python"),
        ({"a_py": python("return LaunchDescription([DeclareLaunchArgument('x')])")}, "required, but not given"),
        ({"a_py": python("return LaunchDescription([OpaqueFunction(function=os.fork)])")}, "not in this file"),
        ({"a_py": "import os\nos.abort()\n" + python("return LaunchDescription([5])")}, "it is not an action"),
        ({"a_xml": "<launch><group/></launch2>"}, "expected"),
        ({"a_xml": "<robot/>"}, "expected <launch>"),
        ({"a_xml": "<launch><machine name='x'/></launch>"}, "an unsupported element"),
        ({"a_xml": "<launch><include file='$(find-pkg-share gone)/x.py'/></launch>"}, "package gone, which is not"),
        ({"a_xml": "<launch><include file='$(var gone)'/></launch>"}, "launch configuration gone, which is not set"),
        ({"a_xml": "<launch><node pkg='a' exec='b' if='maybe'/></launch>"}, "'maybe' is not a condition"),
        ({"a_xml": "<launch><node pkg='a' exec='b'><param from='p.yaml'/></node></launch>"}, "no such file"),
        (
            {"a_xml": "<launch><node pkg='a' exec='b'><param from='p.yaml'/></node></launch>", "p_yaml": "rate: 5"},
            "p.yaml:1:7: expected node: {ros__parameters",
        ),
        ({"a_yaml": "launch: 5"}, "expected launch: with a list"),
        ({"a_yaml": "- ["}, "expected"),
    ],
)
def test_what_cannot_be_evaluated_says_why(files, reason):
    (path,) = [name.replace("_", ".") for name in files if name.startswith("a_")]
    whole = evaluate_ros2(path, Written(**files))
    assert reason in " ".join(one.reason for one in whole.unresolved)
    assert all(one.evidence.path == path for one in whole.unresolved)


@pytest.mark.parametrize(
    ("files", "opens"),
    [
        ({"a_py": python("return LaunchDescription([IncludeLaunchDescription('gone.py')])")}, True),
        ({"a_py": python("return LaunchDescription(read_config())")}, True),
        ({"a_xml": "<launch><include file='$(find-pkg-share gone)/x.py'/></launch>"}, True),
        ({"a_yaml": "launch: 5"}, True),
        ({"a_py": python("return LaunchDescription([DeclareLaunchArgument('x')])")}, False),
        ({"a_xml": "<launch><node pkg='a' exec='b'><param from='p.yaml'/></node></launch>"}, False),
    ],
)
def test_what_may_start_further_nodes_is_told_apart(files, opens):
    (path,) = [name.replace("_", ".") for name in files]
    assert {one.opens for one in evaluate_ros2(path, Written(**files)).unresolved} == {opens}


def test_a_namespace_below_another():
    assert str(within(Text.of("/"), Text.of("a/"))) == "/a"
    assert str(within(Text.of("/a"), Text.of("b"))) == "/a/b"
    assert str(within(Text.of("/a"), Text.of("/c"))) == "/c"
    assert str(within(Text.of("/a"), Text())) == "/a"


def names_below_environment(body, environment=None):
    files = Written(a_launch_py=python(f"return LaunchDescription([{body}])"))
    whole = evaluate_ros2("a.launch.py", files, environment=environment)
    return [(node.namespace.pattern, node.namespace.usual) for node in whole.nodes]


NODE_IN = "Node(package='p', executable='e', namespace={})"


@pytest.mark.parametrize(
    "written",
    [
        "EnvironmentVariable('R', default_value='r1')",
        "EnvironmentVariable(name='R', default_value='r1')",
        "EnvironmentVariable(default_value='r1', name='R')",
        "os.environ.get('R', 'r1')",
    ],
)
def test_a_variable_of_the_environment_keeps_its_default(written):
    assert names_below_environment(NODE_IN.format(written)) == [("/*", "/r1")]
    assert names_below_environment(NODE_IN.format(written), {"R": "r2"}) == [("/r2", "/r2")]


@pytest.mark.parametrize("written", ["EnvironmentVariable('R')", "EnvironmentVariable('R', default_value=unknown())"])
def test_a_variable_of_the_environment_without_a_known_default_is_a_hole(written):
    assert names_below_environment(NODE_IN.format(written)) == [("/*", None)]


def test_a_variable_that_the_launch_file_sets_has_neither_its_default_nor_its_value_before():
    body = "SetEnvironmentVariable('R', 'r3'), " + NODE_IN.format("EnvironmentVariable('R', default_value='r1')")
    assert names_below_environment(body) == [("/*", None)]
    assert names_below_environment(body, {"R": "r2"}) == [("/*", None)]


@pytest.mark.parametrize(("element", "usual"), [("set_env", None), ("unset_env", None), ("log", "/r1")])
def test_elements_that_change_the_environment(element, usual):
    content = (
        f"<launch><{element} name='R' value='r3' message='x'/><node pkg='p' exec='e' namespace='$(env R r1)'/></launch>"
    )
    (node,) = evaluate_ros2("a.launch.xml", Written(a_launch_xml=content)).nodes
    assert node.namespace.usual == usual


def test_a_default_of_an_argument_declared_before():
    body = """return LaunchDescription([
        DeclareLaunchArgument('robot', default_value='rover'),
        DeclareLaunchArgument('given'),
        DeclareLaunchArgument('space', default_value=['/', LaunchConfiguration('robot')]),
        DeclareLaunchArgument('other', default_value=LaunchConfiguration('given')),
        DeclareLaunchArgument('late', default_value=LaunchConfiguration('later')),
        DeclareLaunchArgument('later', default_value='x')])"""
    whole = evaluate_ros2("a.py", Written(a_py=python(body)))
    defaults = {one.name: None if one.default is None else str(one.default) for one in whole.arguments}
    assert defaults == {
        "robot": "rover",
        "given": None,
        "space": "/rover",
        "other": "{argument given, which is not given}",
        "late": "{launch configuration later, which is not set}",
        "later": "x",
    }


def test_a_component_that_is_there_under_a_condition():
    body = """parts = [ComposableNode(package='p', plugin='p::A', name='a')]
    if random.random() > 0.5:
        parts.append(ComposableNode(package='p', plugin='p::B', name='b'))
    return LaunchDescription([ComposableNodeContainer(name='box', composable_node_descriptions=parts)])"""
    before = (
        "from launch_ros.actions import ComposableNodeContainer\nfrom launch_ros.descriptions import ComposableNode"
    )
    found = evaluate_ros2("a.py", Written(a_py=python(body, before))).nodes
    assert [(str(one.plugin), as_written(one.conditions)) for one in found] == [
        ("", ()),
        ("p::A", ()),
        ("p::B", ("random.random() > 0.5",)),
    ]


LOOPS = {
    "xml": """<launch><arg name="robots" default="{name: a, id: 1};{name: b}"/>
        <for_each values="$(var robots)"><node pkg="p" exec="e" name="$(for-var name)$(for-var id 9)"/></for_each>
        <for len="2" name="i"><for len="2" name="k"><node pkg="p" exec="e" name="n$(index i)$(index k)"/></for></for>
        </launch>""",
    "yaml": """launch:
- arg: {name: robots, default: "{name: a, id: 1};{name: b}"}
- for_each:
    values: $(var robots)
    children:
    - node: {pkg: p, exec: e, name: $(for-var name)$(for-var id 9)}
- for:
    len: "2"
    name: i
    children:
    - for: {len: "2", name: k, children: [{node: {pkg: p, exec: e, name: n$(index i)$(index k)}}]}
""",
}


@pytest.mark.parametrize("extension", LOOPS)
def test_loops_start_their_actions_once_a_turn(extension):
    whole = evaluate_ros2(f"a.{extension}", Written(**{f"a_{extension}": LOOPS[extension]}))
    assert [one.name.known for one in whole.nodes] == ["a1", "b9", "n00", "n01", "n10", "n11"]
    assert not whole.unresolved


@pytest.mark.parametrize("loop", ['<for len="$(env N)" name="i">%s</for>', '<for_each values="x">%s</for_each>'])
def test_a_loop_that_is_not_known_is_told(loop):
    node = '<node pkg="p" exec="e"/>'
    whole = evaluate_ros2("a.xml", Written(a_xml=f"<launch>{loop % node}</launch>"))
    assert whole.nodes == ()
    assert [one.reason for one in whole.unresolved] == ["it is unknown how often it starts its actions"]
