import pytest

from roslens.model.words.command_name import command_name


@pytest.mark.parametrize(
    ("command", "name"),
    [
        ("", ""),
        ("/opt/ros/lib/nav2_amcl/amcl --ros-args -r __node:=amcl", "amcl"),
        ("/usr/bin/python3 /home/robot/lidar.py --rate=5", "lidar.py"),
        ("python3.11 -u -m robot.planner --ros-args", "robot.planner"),
        ("python -c import sys; sys.exit()", "python -c"),
        ("bash -x start.sh", "start.sh"),
        ("python3 -m", "python3"),
        ("python3", "python3"),
        ("pythonic_node", "pythonic_node"),
        ("component_container/ x", "component_container"),
    ],
)
def test_names_of_programs(command, name):
    assert command_name(command) == name
