import pytest

from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

FILE = """\
talker:
  ros__parameters:
    rate: 5
    name: <robot>
    enabled: ZONE
    share: $(var robot)/x
    topic: "$(var unset)"
    inner: {rate: 1.5}
"""
LAUNCH = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterFile
from nav2_common.launch import ReplaceString, RewrittenYaml
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('robot', default_value='r2'),
        DeclareLaunchArgument('zone', default_value='True'),
        DeclareLaunchArgument('unset'),
        Node(package='p', executable='talker', parameters=[%s]),
    ])
"""


class Written:
    def __init__(self, **files):
        self.files = {name.replace("_", "."): content.encode() for name, content in files.items()}

    def package(self, name):
        return None

    def content(self, path):
        return self.files.get(path)


def told(given, content=FILE):
    whole = evaluate_ros2("a.py", Written(a_py=LAUNCH % given, p_yaml=content))
    (node,) = whole.nodes
    missed = [one for one in whole.unresolved if one.text != "unset"]
    return {str(one.name): (str(one.value), one.type, one.node) for one in node.settings}, missed


def test_a_file_as_it_stands():
    found, missed = told("'p.yaml'")
    assert found["name"] == ("<robot>", "string", "/talker")
    assert found["share"] == ("$(var robot)/x", "string", "/talker")
    assert not missed


def test_substitutions_are_replaced_where_that_is_allowed():
    found, _ = told("ParameterFile('p.yaml', allow_substs=True)")
    assert found["share"] == ("r2/x", "string", "/talker")
    assert found["topic"][0].startswith("{argument ")
    assert found["topic"][1] == ""
    assert told("ParameterFile('p.yaml', allow_substs=False)")[0]["share"][0] == "$(var robot)/x"
    content = "talker:\n  ros__parameters:\n    a: $(var zone)\n    b: '$(var zone)'\n    c: [$(var robot), '1']\n"
    found, _ = told("ParameterFile('p.yaml', allow_substs=True)", content)
    assert {name: value[:2] for name, value in found.items()} == {
        "a": ("True", "bool"),
        "b": ("True", "string"),
        "c": ("[r2, 1]", "string_array"),
    }


def test_values_are_rewritten_by_name_and_by_what_they_were():
    rewritten = (
        "ParameterFile(RewrittenYaml(source_file='p.yaml', root_key=LaunchConfiguration('robot'), "
        "param_rewrites={'inner.rate': '7', 'name': LaunchConfiguration('unset')}, "
        "value_rewrites={'ZONE': LaunchConfiguration('zone')}, convert_types=True), allow_substs=True)"
    )
    found, _ = told(rewritten)
    assert found["rate"] == ("5", "int", "/r2/talker")
    assert found["inner.rate"] == ("7", "int", "/r2/talker")
    assert found["enabled"] == ("True", "bool", "/r2/talker")
    assert found["share"][0] == "r2/x"
    assert (found["name"][0][:9], found["name"][1]) == ("{argument", "")
    content = "talker:\n  ros__parameters:\n    c: ['$(var robot)/x']\n    d: $(var zone)\n"
    assert told(rewritten, content)[0] == {
        "c": ("[r2/x]", "string_array", "/r2/talker"),
        "d": ("True", "bool", "/r2/talker"),
    }


@pytest.mark.parametrize(
    ("more", "name"),
    [
        ("", "/r2"),
        (", condition=IfCondition(LaunchConfiguration('zone'))", "/r2"),
        (", condition=IfCondition('false')", "<robot>"),
        (", condition=IfCondition(LaunchConfiguration('unset'))", "<robot>"),
    ],
)
def test_texts_are_replaced(more, name):
    given = "ReplaceString(source_file='p.yaml', replacements={'<robot>': ('/', LaunchConfiguration('robot'))}%s)"
    assert told(given % more)[0]["name"][0] == name


def test_what_is_put_in_and_not_known_is_a_hole():
    given = "ReplaceString(source_file='p.yaml', replacements={'<robot>': LaunchConfiguration('unset'), 'talker': 'x'})"
    found, _ = told(given)
    assert (found["name"][0][:9], found["name"][1]) == ("{argument", "")
    assert found["rate"][2] == "/x"


def test_a_file_that_is_refused_or_missing_is_told():
    assert told("'p.yaml'", "talker: 5\n")[1][0].text == "a value outside of ros__parameters"
    assert [one.reason for one in told("'gone.yaml'")[1]] == ["there is no such file in the workspace"]


def test_xml_allows_substitutions_too():
    launch = """<launch><arg name="robot" default="r2"/><node pkg="p" exec="talker">
    <param from="p.yaml" allow_substs="true"/></node></launch>"""
    (node,) = evaluate_ros2("a.xml", Written(a_xml=launch, p_yaml=FILE)).nodes
    assert {str(one.name): str(one.value) for one in node.settings}["share"] == "r2/x"


def rewritten(arguments, content=FILE):
    return told(f"RewrittenYaml(source_file='p.yaml', {arguments})", content)[0]


@pytest.mark.parametrize(
    ("root", "node"),
    [
        ("None", "/talker"),
        ("''", "/talker"),
        ("'a/b'", "/a/b/talker"),
        ("LaunchConfiguration('unset')", "/**/talker"),
    ],
)
def test_all_of_a_file_is_below_its_root_and_an_unknown_one_is_any(root, node):
    assert {one[2] for one in rewritten(f"param_rewrites={{}}, root_key={root}").values()} == {node}


def test_a_value_is_rewritten_by_its_path_and_added_where_the_file_has_none():
    found = rewritten(
        "param_rewrites={'talker.ros__parameters.rate': '9', 'other.ros__parameters.x': '1'}, convert_types=True"
    )
    assert found["rate"] == ("9", "int", "/talker")
    assert found["x"] == ("1", "int", "/other")


def test_without_conversion_a_rewritten_value_is_a_text():
    assert rewritten("param_rewrites={'rate': '9'}")["rate"] == ("9", "string", "/talker")


def test_keys_are_rewritten_of_nodes_too():
    found = rewritten("param_rewrites={}, key_rewrites={'talker': LaunchConfiguration('robot'), 'rate': 'speed'}")
    assert found["inner.speed"] == ("1.5", "double", "/r2")
    assert found["speed"][2] == "/r2"


@pytest.mark.parametrize("given", ["param_rewrites=unknown()", "param_rewrites={**unknown()}"])
def test_rewriting_that_is_unknown_leaves_no_value_known(given):
    found = rewritten(given)
    assert all(value.startswith("{") for value, _, _ in found.values())
    assert {node for _, _, node in found.values()} == {"/talker"}


INCLUDED = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from nav2_common.launch import RewrittenYaml
def generate_launch_description():
    again = RewrittenYaml(source_file=LaunchConfiguration('file'), param_rewrites={'name': 'twice'}, root_key='top')
    return LaunchDescription([
        DeclareLaunchArgument('file'),
        Node(package='p', executable='a', parameters=[LaunchConfiguration('file')]),
        Node(package='p', executable='b', parameters=[again]),
    ])
"""
INCLUDING = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from nav2_common.launch import ReplaceString, RewrittenYaml
def generate_launch_description():
    first = ReplaceString(source_file='p.yaml', replacements={'ZONE': LaunchConfiguration('zone')})
    file = RewrittenYaml(source_file=first, root_key=LaunchConfiguration('ns'), param_rewrites={})
    return LaunchDescription([
        DeclareLaunchArgument('ns', default_value='r1'),
        DeclareLaunchArgument('zone', default_value='True'),
        IncludeLaunchDescription(PythonLaunchDescriptionSource('b.py'), launch_arguments={'file': file}.items()),
    ])
"""


def test_a_rewritten_file_may_go_through_an_argument_to_another_launch_file():
    whole = evaluate_ros2("a.py", Written(a_py=INCLUDING, b_py=INCLUDED, p_yaml=FILE))
    assert not whole.unresolved
    one, other = ({str(two.name): (str(two.value), two.node) for two in node.settings} for node in whole.nodes)
    assert one["enabled"] == ("True", "/r1/talker")
    assert other["name"] == ("twice", "/top/r1/talker")
    assert other["enabled"] == ("True", "/top/r1/talker")


def test_an_absolute_path_is_none_of_the_workspace():
    assert [one.text for one in told("'/p.yaml'")[1]] == ["/p.yaml"]


def test_a_list_of_texts_is_the_path_of_one_file():
    found, missed = told("['p', '.yaml']")
    assert found["rate"] == ("5", "int", "/talker")
    assert not missed
