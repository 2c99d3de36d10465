"""Packages that a package needs for the plug-ins that its parameter files and robot descriptions name.

Sources of the table: the plug-in descriptions of ros-controls/ros2_controllers, ros2_control, gz_ros2_control and
ros_controllers, ros-navigation/navigation2 and navigation, moveit/moveit2, each in its supported branches.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from posixpath import dirname

from roslens.model.source import Language, Role, SourceFile
from roslens.source.rules.by_package.left_behind import is_earlier, is_left_behind
from roslens.source.rules.views.package_files import PackageFiles

_LIKE_THEMSELVES = """
    ackermann_steering_controller admittance_controller battery_state_broadcaster bicycle_steering_controller
    chained_filter_controller diff_drive_controller force_torque_sensor_broadcaster forward_command_controller
    gpio_controllers gps_sensor_broadcaster imu_sensor_broadcaster joint_state_broadcaster joint_state_controller
    joint_trajectory_controller magnetometer_broadcaster mecanum_drive_controller motion_primitives_controllers
    omni_wheel_drive_controller pid_controller pose_broadcaster range_sensor_broadcaster state_interfaces_broadcaster
    tricycle_controller tricycle_steering_controller velocity_controllers effort_controllers position_controllers
    imu_sensor_controller force_torque_sensor_controller four_wheel_steering_controller
    gz_ros2_control ign_ros2_control gazebo_ros2_control
    nav2_behaviors nav2_recoveries nav2_bt_navigator nav2_constrained_smoother nav2_controller nav2_costmap_2d
    nav2_graceful_controller nav2_mppi_controller nav2_navfn_planner nav2_regulated_pure_pursuit_controller
    nav2_rotation_shim_controller nav2_route nav2_smac_planner nav2_smoother nav2_theta_star_planner
    nav2_waypoint_follower dwb_core dwb_critics dwb_plugins opennav_docking teb_local_planner
    moveit_simple_controller_manager pilz_industrial_motion_planner trac_ik_kinematics_plugin
"""
_UNLIKE = {
    "parallel_gripper_action_controller": "parallel_gripper_controller",
    "kdl_kinematics_plugin": "moveit_kinematics",
    "lma_kinematics_plugin": "moveit_kinematics",
    "cached_ik_kinematics_plugin": "moveit_kinematics",
    "srv_kinematics_plugin": "moveit_kinematics",
    "ompl_interface": "moveit_planners_ompl",
    "chomp_interface": "moveit_planners_chomp",
    "stomp_moveit": "moveit_planners_stomp",
    "moveit_ros_control_interface": "moveit_ros_control_interface",
}
_TRAJECTORY = "JointTrajectoryController"
_GRIPPER = "GripperActionController"
_OF_GRIPPERS = {1: "gripper_action_controller", 2: "gripper_controllers"}
"""By version of ROS, the package with the classes of that name that are in namespaces of joint controllers."""
_DESCRIPTIONS = (Language.XACRO, Language.URDF)
_ASIDE = re.compile(r"(?:^|/)(?:tests?|examples?|demos?|docs?|templates?)(?:/|$)")


@cache
def packages() -> dict[str, str]:
    """Return the package that has the classes of a namespace, by that namespace."""
    return {**{name: name for name in _LIKE_THEMSELVES.split()}, **_UNLIKE}


def plugins_named(view: PackageFiles) -> Iterator[tuple[str, str, str, int]]:
    """Yield each known plug-in that a package names: the package that has it, its type, the path and the line."""
    names = {path.rpartition("/")[2] for path in view.listing}
    for file in view.of_language(Language.YAML, *_DESCRIPTIONS, roles=(Role.OWN,)):
        if _ASIDE.search(view.inside(dirname(file.path))) or is_left_behind(file.path) or is_earlier(file.path, names):
            continue
        yield from _named_in(view.read(file.path), file, 2 if 2 in view.ros else 1)


def _named_in(content: bytes, file: SourceFile, ros: int) -> Iterator[tuple[str, str, str, int]]:
    if b"::" not in content and b"/" not in content:
        return
    is_yaml = file.language is Language.YAML
    for match in (_in_parameters() if is_yaml else _in_description()).finditer(content):
        space, name = match[1].decode(), match[3].decode()
        start = match.start(1)
        if is_yaml and b"#" in content[content.rfind(b"\n", 0, start) + 1 : start]:
            continue
        line = content.count(b"\n", 0, start) + 1
        yield _package_of(space, name, ros), f"{space}{match[2].decode()}{name}", file.path, line


def _package_of(space: str, name: str, ros: int) -> str:
    if space.endswith("_controllers") and name == _TRAJECTORY:
        return "joint_trajectory_controller"
    if space.endswith("_controllers") and name == _GRIPPER:
        return _OF_GRIPPERS[ros]
    return packages()[space]


def _spaces() -> bytes:
    return "|".join(sorted(map(re.escape, packages()), key=lambda name: (-len(name), name))).encode()


@cache
def _in_parameters() -> re.Pattern[bytes]:
    """Return a pattern of a whole value: behind ``: ``, ``- ``, ``[`` or ``,``, quoted or not."""
    return re.compile(
        rb"(?:[:\-\[,][ \t]+|\[)[\"']?(" + _spaces() + rb")(::|/)([A-Z]\w*)(?![\w:/.])[\"']?[ \t]*(?=[\n\r,\]#]|$)"
    )


@cache
def _in_description() -> re.Pattern[bytes]:
    return re.compile(rb"<plugin>\s*(" + _spaces() + rb")(::|/)([A-Z]\w*)\s*</plugin>")
