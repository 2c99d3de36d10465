"""What ends a launch with an error, and what is only not known: by file and line, in files of both generations."""

import pytest

from roslens.intake.file_budget import refuse, refuse_only
from roslens.model.configuration import Standing
from roslens.source.extract.facts.launched import Fault
from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
from roslens.source.extract.launch.substitution_text import arguments_of


class Workspace:
    """A workspace of one package, ``p``, in the folder ``src/p``."""

    def __init__(self, files):
        self.files = {path: text.encode() for path, text in files.items()}

    def package(self, name):
        return "src/p" if name == "p" else None

    def content(self, path):
        return self.files.get(path)

    def listing(self, folder):
        return tuple(path for path in self.files if path.startswith(f"{folder}/"))


def failed(text, path="src/p/launch/a.launch.xml", evaluate=evaluate_ros2, **others):
    files = Workspace({path: text, **{f"src/p/{name}": content for name, content in others.pop("files", {}).items()}})
    return [(one.fault, one.evidence.line, one.open) for one in evaluate(path, files, **others).failed]


ROS_2 = {
    "not set": ('<launch>\n<node pkg="a" exec="b" name="$(var x)"/></launch>', [(Fault.NOT_SET, 2, False)]),
    "default": ('<launch><node pkg="a" exec="b" name="$(var x y)"/></launch>', []),
    "declared": ('<launch><arg name="x" default="1"/><node pkg="a" exec="b" name="$(var x)"/></launch>', []),
    "required": ('<launch><arg name="x"/><node pkg="a" exec="b" name="$(var x)"/></launch>', []),
    "set by an include": (
        '<launch><include file="$(find-pkg-share p)/launch/b.launch.xml"/><let name="y" value="$(var set)"/></launch>',
        [],
    ),
    "behind what is elsewhere": (
        '<launch><include file="$(find-pkg-share q)/launch/b.launch.xml"/><let name="y" value="$(var x)"/></launch>',
        [],
    ),
    "in an open branch": (
        '<launch><arg name="c"/>\n<let if="$(var c)" name="y" value="$(var x)"/></launch>',
        [(Fault.NOT_SET, 2, True)],
    ),
    "in a branch that is not taken": ('<launch><let if="false" name="y" value="$(var x)"/></launch>', []),
    "not chosen": ('<launch><let name="y" value="$(if true a $(var x))"/></launch>', []),
    "no name": ('<launch>\n<let name="y" value="$(eval \'not true\')"/></launch>', [(Fault.EXPRESSION, 2, False)]),
    "no Python": ('<launch>\n<let name="y" value="$(eval \'1 +\')"/></launch>', [(Fault.EXPRESSION, 2, False)]),
    "divided": ('<launch>\n<let name="y" value="$(eval \'1 / 0\')"/></launch>', [(Fault.EXPRESSION, 2, False)]),
    "names of Python": ('<launch><let name="y" value="$(eval \'hex(3) or pi\')"/></launch>', []),
    "text as condition": ('<launch>\n<group if="maybe"/></launch>', [(Fault.EXPRESSION, 2, False)]),
    "missing include": (
        '<launch>\n<include file="$(find-pkg-share p)/launch/gone.launch.xml"/></launch>',
        [(Fault.MISSING_FILE, 2, False)],
    ),
    "missing file of parameters": (
        '<launch>\n<node pkg="a" exec="b"><param from="$(find-pkg-share p)/gone.yaml"/></node></launch>',
        [(Fault.MISSING_FILE, 2, False)],
    ),
    "absolute path": ('<launch><include file="/opt/a.launch.xml"/></launch>', []),
    "itself": ('<launch>\n<include file="$(dirname)/a.launch.xml"/></launch>', [(Fault.CYCLE, 2, False)]),
}


@pytest.mark.parametrize(("text", "expected"), ROS_2.values(), ids=ROS_2)
def test_ros_2(text, expected):
    other = '<launch><arg name="set" default="1"/></launch>'
    assert failed(text, files={"launch/b.launch.xml": other}) == expected


def test_open_arguments_follow_every_way():
    text = """<launch>
    <arg name="sim" default="false"/>
    <group if="$(var sim)"><let name="y" value="$(var x)"/></group>
    <let name="z" value="$(eval '$(var sim)')"/>
    </launch>"""
    assert failed(text) == [(Fault.EXPRESSION, 4, False)]
    assert failed(text, any_arguments=True) == [(Fault.NOT_SET, 3, True)]


ROS_1 = {
    "no name": ('<launch>\n<param name="a" value="$(eval yes)"/></launch>', [(Fault.EXPRESSION, 2, False)]),
    "true is a name": ('<launch><param name="a" value="$(eval true)"/></launch>', []),
    "an argument that must be given": ('<launch><arg name="b"/><param name="a" value="$(eval b == 1)"/></launch>', []),
    "not declared": ('<launch><param name="a" value="$(arg b)"/></launch>', []),
    "no attribute": ('<launch>\n<node pkg="a" name="b"/></launch>', [(Fault.REFUSED, 2, False)]),
    "condition": ('<launch>\n<group if="yes"/></launch>', [(Fault.EXPRESSION, 2, False)]),
    "missing include": (
        '<launch>\n<include file="$(find p)/launch/gone.launch"/></launch>',
        [(Fault.MISSING_FILE, 2, False)],
    ),
    "missing rosparam": ('<launch>\n<rosparam file="$(find p)/gone.yaml"/></launch>', [(Fault.MISSING_FILE, 2, False)]),
    "elsewhere": ('<launch><include file="$(find q)/launch/gone.launch"/></launch>', []),
    "no YAML": ("<launch>\n<rosparam>\na: [1\n</rosparam></launch>", [(Fault.PARAMETERS, 2, False)]),
    "a tag of YAML": ("<launch>\n<rosparam>\na: !degrees 90\n</rosparam></launch>", []),
    "itself": ('<launch>\n<include file="$(dirname)/a.launch"/></launch>', [(Fault.CYCLE, 2, False)]),
}


@pytest.mark.parametrize(("text", "expected"), ROS_1.values(), ids=ROS_1)
def test_ros_1(text, expected):
    assert failed(text, "src/p/launch/a.launch", evaluate_ros1) == expected


def test_what_is_not_resolved_says_whether_it_fails_is_elsewhere_or_undecidable():
    text = """<launch>
    <include file="$(find-pkg-share q)/a.launch.xml"/>
    <include file="$(env HOME)/a.launch.xml"/>
    <include file="$(command date)/a.launch.xml"/>
    <include file="$(find-pkg-share p)/launch/gone.launch.xml"/>
    </launch>"""
    path = "src/p/launch/a.launch.xml"
    found = evaluate_ros2(path, Workspace({path: text})).unresolved
    outside, undecidable, failure = Standing.OUTSIDE, Standing.UNDECIDABLE, Standing.FAILURE
    assert [one.standing for one in found] == [outside, outside, undecidable, failure]


def test_files_that_rcl_reads_as_they_are():
    text = """from launch import LaunchDescription
from launch_ros.actions import ComposableNodeContainer, Node
from launch_ros.descriptions import ComposableNode, ParameterFile


def generate_launch_description():
    return LaunchDescription([
        Node(package="a", executable="b", parameters=["src/p/one.yaml"]),
        Node(package="a", executable="b", parameters=[ParameterFile("src/p/two.yaml", allow_substs=True)]),
        ComposableNodeContainer(package="a", executable="b", composable_node_descriptions=[
            ComposableNode(package="a", plugin="c", parameters=["src/p/three.yaml"]),
        ]),
    ])
"""
    path = "src/p/launch/a.launch.py"
    found = evaluate_ros2(path, Workspace({path: text})).raw_files
    assert [(one.path, one.evidence.line) for one in found] == [("src/p/one.yaml", 8)]


def test_cycles_and_long_files_end():
    files = {
        f"src/p/launch/{one}.launch.xml": '<launch>\n<include file="$(dirname)/{}.launch.xml"/></launch>'
        for one in "ab"
    }
    files = {path: text.format("b" if "/a." in path else "a") for path, text in files.items()}
    found = evaluate_ros2("src/p/launch/a.launch.xml", Workspace(files)).failed
    assert [(one.fault, one.evidence.path) for one in found] == [(Fault.CYCLE, "src/p/launch/b.launch.xml")]
    long = "<launch>" + '<node pkg="a" exec="b" name="$(var x)"/>\n' * 100_000 + "</launch>"
    assert len(failed(long)) <= 500


@pytest.mark.parametrize(
    ("written", "count"),
    [
        ("1+2", 1),
        ("'1 + 2'", 1),
        ("$(var n)==2", 1),
        ("\"'$(var x)' == 'a b'\"", 1),
        (r"'\'$(var x)\' == \'a b\''", 1),
        ("'$(var n) > 1' math", 2),
        ("not $(var x)", 2),
        ("1 + 2", 3),
        ("$(var n) == 2", 3),
        ("'$(var n)' == '2'", 3),
        ("", 0),
    ],
)
def test_blanks_part_the_arguments_of_an_expression_as_the_grammar_of_launch_has_it(written, count):
    assert arguments_of(written) == count
    value = f"$(eval {written})".replace('"', "&quot;")
    text = f'<launch><arg name="n" default="2"/><arg name="x" default="1"/><let name="y" value="{value}"/></launch>'
    is_module = written.endswith("math")
    assert bool(failed(text)) is (count != 1 and not is_module)


@pytest.mark.parametrize("written", ["yes", "on", "", "off", "2"])
def test_a_condition_takes_fewer_words_than_a_substitution(written):
    assert failed(f'<launch>\n<group if="{written}"/></launch>') == [(Fault.EXPRESSION, 2, False)]
    assert failed('<launch><group if="TRUE"/><group unless="0"/></launch>') == []


@pytest.mark.parametrize("evaluate", [evaluate_ros1, evaluate_ros2], ids=["ros1", "ros2"])
def test_a_file_that_is_left_out_is_told_and_not_read_again(evaluate):
    files = Workspace({"src/p/launch/a.launch.xml": "<launch/>"})
    refuse({"src/p/launch/a.launch.xml": "it breaks the parser"})
    try:
        launch = evaluate("src/p/launch/a.launch.xml", files)
    finally:
        refuse_only({})
    assert launch.cut
    assert [one.reason for one in launch.unresolved] == ["it breaks the parser"]
