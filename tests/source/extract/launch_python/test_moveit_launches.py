"""Launch files that MoveIt generates: what the functions of moveit_configs_utils start."""

import pytest

from roslens.source.extract.launch.launch_ros2 import evaluate_ros2

FILE = """
from moveit_configs_utils import MoveItConfigsBuilder
from moveit_configs_utils.launches import generate_{name}_launch


def generate_launch_description():
    configs = MoveItConfigsBuilder("arm", package_name="arm_moveit").robot_description("x").to_moveit_configs()
    return generate_{name}_launch(configs)
"""
NAMES = ("rsp", "moveit_rviz", "setup_assistant", "move_group", "warehouse_db", "spawn_controllers", "demo",
         "static_virtual_joint_tfs")  # fmt: skip
CONTROLLERS = b"moveit_simple_controller_manager:\n  controller_names: [arm_controller, hand_controller]\n"
PUT_TOGETHER = "parameters that moveit_configs_utils puts together"


class Files:
    def __init__(self, **more):
        self.files = {f"src/arm/launch/{name}.launch.py": FILE.format(name=name).encode() for name in NAMES[:-1]}
        self.files["src/arm/config/ros2_controllers.yaml"] = (
            b"controller_manager:\n  ros__parameters: {update_rate: 9}\n"
        )
        self.files |= more

    def package(self, name):
        return "src/arm" if name == "arm_moveit" else None

    def content(self, path):
        return self.files.get(path)


def started(name, arguments=None, **more):
    found = evaluate_ros2(f"src/arm/launch/{name}.launch.py", Files(**more), arguments)
    return [(one.package.known, one.executable.known) for one in found.nodes], {one.reason for one in found.unresolved}


@pytest.mark.parametrize(
    ("name", "node"),
    [
        ("rsp", ("robot_state_publisher", "robot_state_publisher")),
        ("moveit_rviz", ("rviz2", "rviz2")),
        ("setup_assistant", ("moveit_setup_assistant", "moveit_setup_assistant")),
        ("move_group", ("moveit_ros_move_group", "move_group")),
        ("warehouse_db", ("warehouse_ros_mongo", "mongo_wrapper_ros.py")),
    ],
)
def test_one_node_with_parameters_that_are_not_followed(name, node):
    assert started(name) == ([node], {PUT_TOGETHER})


def test_a_spawner_for_each_controller_and_the_broadcaster():
    spawner = ("controller_manager", "spawner")
    known = {"src/arm/config/moveit_controllers.yaml": CONTROLLERS}
    assert started("spawn_controllers", **known) == ([spawner] * 3, set())
    nodes, reasons = started("spawn_controllers")
    assert (nodes, reasons) == ([spawner], {"it is unknown what it starts"})


def test_a_demonstration_includes_the_others():
    known = {"src/arm/config/moveit_controllers.yaml": CONTROLLERS}
    nodes, reasons = started("demo", **known)
    assert [program for _package, program in nodes] == [
        "robot_state_publisher", "move_group", "rviz2", "ros2_control_node", "spawner", "spawner", "spawner",
    ]  # fmt: skip
    assert reasons == {PUT_TOGETHER}
    without = started("demo", {"use_rviz": "false", "db": "true"}, **known)[0]
    assert ("rviz2", "rviz2") not in without
    assert ("warehouse_ros_mongo", "mongo_wrapper_ros.py") in without


def test_virtual_joints_are_not_followed():
    name = NAMES[-1]
    more = {f"src/arm/launch/{name}.launch.py": FILE.format(name=name).encode()}
    assert started(name, **more) == ([], {"it is unknown what it starts"})
    assert "it is unknown what it starts" in started("demo", **more)[1]


def test_parameters_of_a_configuration_are_not_followed():
    text = FILE.format(name="rsp").replace(
        "return generate_rsp_launch(configs)",
        "given = [configs.to_dict(), configs.joint_limits, {'a': 1}]\n"
        "    return LaunchDescription([Node(package='p', executable='e', parameters=given)])",
    )
    text = f"from launch import LaunchDescription\nfrom launch_ros.actions import Node\n{text}"
    found = evaluate_ros2("src/arm/launch/x.launch.py", Files(**{"src/arm/launch/x.launch.py": text.encode()}))
    assert [one.reason for one in found.unresolved] == [PUT_TOGETHER]
    assert [str(one.name) for node in found.nodes for one in node.settings] == ["a"]
