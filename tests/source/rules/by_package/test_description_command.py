"""A robot description without a type by the command that it is the output of."""

import pytest

from roslens.model.finding import Severity
from roslens.source.rules.package_findings import rule_findings
from roslens.source.settings import RuleSettings

MANIFEST = "<package format='3'><name>arm</name><export><build_type>ament_cmake</build_type></export></package>"
LAUNCH = """from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.substitutions import Command, FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import ExecutableInPackage, FindPackageShare


def generate_launch_description():
    file = PathJoinSubstitution([FindPackageShare("arm"), "urdf", "arm.urdf.xacro"])
    read = Command({})
    return LaunchDescription([Node(package="p", executable="e", parameters=[{{"robot_description": read}}])])
"""
DROPPED = (
    "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'>\n<!-- elbow: left -->\n"
    "<xacro:property name='b' value='1'/>\n</robot>"
)
KEPT = "<robot>\n<!-- elbow: left -->\n<link name='a'/>\n</robot>"


def severities(folder, package_view, command, description):
    (folder / "launch").mkdir()
    (folder / "package.xml").write_text(MANIFEST)
    (folder / "arm.urdf.xacro").write_text(description)
    (folder / "launch" / "a.launch.py").write_text(LAUNCH.format(command))
    failures = []
    settings = RuleSettings((), ("launch.description_type",))
    found = [one.severity for one in rule_findings(package_view(folder), settings, {}, (), (), failures)]
    assert not failures
    return found


@pytest.mark.parametrize(
    ("command", "description", "expected"),
    [
        ('["xacro ", file]', KEPT, [Severity.WARNING]),
        ('["xacro ", file]', DROPPED, [Severity.NOTE]),
        ('["xacro", " ", file]', DROPPED, [Severity.NOTE]),
        ('[FindExecutable(name="xacro"), " ", file]', KEPT, [Severity.WARNING]),
        ('[PathJoinSubstitution([FindExecutable(name="xacro")]), " ", file]', DROPPED, [Severity.NOTE]),
        ('[ExecutableInPackage("xacro", "xacro"), " ", file]', DROPPED, [Severity.NOTE]),
        ('["ros2 run xacro xacro ", file]', DROPPED, [Severity.NOTE]),
        ('["cat ", file]', DROPPED, [Severity.WARNING]),
        ("[file]", KEPT, []),
        ("file", KEPT, []),
        ('[file, " gripper:=true"]', KEPT, []),
        ('[get_package_share_directory("arm") + "/urdf/arm.urdf"]', KEPT, []),
        ('[LaunchConfiguration("model")]', KEPT, []),
    ],
)
def test_it_depends_on_the_program_and_what_it_puts_out(command, description, expected, package_view, tmp_path):
    assert severities(tmp_path, package_view, command, description) == expected
