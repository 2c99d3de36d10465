"""Parameters of launch files of ROS 1; test_launch_ros1_against_roslaunch.py holds all of it against roslaunch."""

import pytest

from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
from roslens.source.extract.launch.ros1_settings import boolean
from roslens.source.extract.launch.ros1_substitution import SubstitutionError


class Written:
    def __init__(self, **files):
        self.files = {name.replace("_", "."): content.encode() for name, content in files.items()}

    def package(self, name):
        return None

    def content(self, path):
        return self.files.get(path)


def settings(inside, **more):
    whole = evaluate_ros1("a.launch", Written(a_launch=f"<launch>{inside}</launch>", **more))
    assert whole.unresolved == ()
    return [(str(one.name), str(one.value), one.type) for one in whole.settings]


@pytest.mark.parametrize(
    ("inside", "found"),
    [
        ("<param name=' a ' value=' 1 '/>", [("/a", "1", "int")]),
        ("<param name='a' value='1e5'/>", [("/a", "1e5", "string")]),
        ("<param name='a' value='.5' type='double'/>", [("/a", ".5", "double")]),
        ("<param name='a' value='1' type='bool'/>", [("/a", "true", "bool")]),
        ("<param name='a' value='{b: 1, c: [x]}' type='yaml'/>",
         [("/a/b", "1", "int"), ("/a/c", "[x]", "string_array")]),
        ("<param name='a' textfile='t.txt'/>", [("/a", "17", "int")]),
        ("<param name='a' textfile='long.txt'/>", [("/a", "{content of long.txt}", "string")]),
        ("<param name='a' command='date +%s'/>", [("/a", "{output of date +%s}", "")]),
        ("<rosparam param='a' ns='n'>5</rosparam>", [("/n/a", "5", "int")]),
        ("<rosparam param='/a' ns='n'>k: 5</rosparam>", [("/a/k", "5", "int")]),
        ("<rosparam>k: {/abs: 1}</rosparam>", [("/abs", "1", "int")]),
        ("<rosparam>k: deg(180)</rosparam>", [("/k", "3.141592653589793", "double")]),
        ("<rosparam>k: {}</rosparam>", []),
        ("<rosparam command='delete' param='a'/><rosparam command='dump' file='x'/>", []),
        ("<arg name='x' value='7'/><rosparam subst_value='True'>k: $(arg x)</rosparam>", [("/k", "7", "int")]),
    ],
)  # fmt: skip
def test_what_is_set(inside, found):
    assert settings(inside, t_txt="17", long_txt="x" * 500) == found


def test_attributes_are_true_or_false():
    assert [boolean(one, "x") for one in ("true", "False")] == [True, False]
    with pytest.raises(SubstitutionError, match='x="1" is neither true nor false'):
        boolean("1", "x")
