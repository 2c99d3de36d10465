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
