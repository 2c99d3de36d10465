"""Arguments given to launch files of other packages of a workspace, for ROS 1."""

import pytest

from roslens.source.rules.package_findings import rule_findings
from roslens.source.settings import RuleSettings

MANIFEST = """<package format="2">
  <name>{0}</name>
  <version>0.1.0</version>
  <description>Drives around.</description>
  <maintainer email="robot@example.org">robot</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>catkin</buildtool_depend>
</package>
"""
EYE = '<launch>\n  <arg name="width" default="320"/>\n  <param name="width" value="$(arg width)"/>\n</launch>\n'


@pytest.fixture
def told(tmp_path, package_view):
    def of(include, eye=EYE):
        for name, text in (("eye", eye), ("grasp", f"<launch>\n{include}\n</launch>\n")):
            (tmp_path / name / "launch").mkdir(parents=True)
            (tmp_path / name / "package.xml").write_text(MANIFEST.format(name))
            (tmp_path / name / "launch" / f"{name}.launch").write_text(text)
        settings = RuleSettings(profiles=(), enable=("launch.include_argument",))
        found = rule_findings(package_view(tmp_path, "grasp"), settings, {}, (), (), [])
        return [(one.path, one.line, one.message) for one in found]

    return of


def include(argument, more=""):
    return f'<include file="$(find eye)/launch/eye.launch"{more}>\n  <arg name="{argument}" value="640"/>\n</include>'


def test_an_argument_that_a_file_of_another_package_does_not_declare_is_told(told):
    ((path, line, message),) = told(include("infra_width"))
    assert (path, line) == ("grasp/launch/grasp.launch", 3)
    assert message == (
        "argument 'infra_width' is given to eye.launch, which does not declare it: "
        "roslaunch ends with \"unused args\"; expected 'width'"
    )


@pytest.mark.parametrize(
    "written",
    [
        include("width"),
        include("infra_width", ' pass_all_args="true"'),
        include("infra_width", ' if="0"'),
        include("infra_width").replace("eye.launch", "gone.launch"),
        include("infra_width").replace("find eye", "find far"),
        include("infra_width").replace("eye.launch", "$(arg robot).launch"),
    ],
)
def test_what_is_declared_passed_on_left_out_or_not_here_is_none(told, written):
    assert not told(written)


def test_a_file_that_cannot_be_read_is_none(told):
    assert not told(include("infra_width"), "<launch>")
