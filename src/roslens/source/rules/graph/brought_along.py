"""Which dependency of a package has another one among its own, so that both are installed together."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.source import Package

_STANDARD = (
    "actionlib_msgs", "diagnostic_msgs", "geometry_msgs", "nav_msgs", "sensor_msgs", "shape_msgs", "std_msgs",
    "std_srvs", "stereo_msgs", "trajectory_msgs", "visualization_msgs",
)  # fmt: skip
_KNOWN: Mapping[str, tuple[str, ...]] = {
    "ackermann_msgs": ("std_msgs",),
    "actionlib": ("actionlib_msgs", "std_msgs"),
    "actionlib_msgs": ("std_msgs",),
    "amcl": ("geometry_msgs", "nav_msgs", "sensor_msgs", "std_srvs"),
    "base_local_planner": ("geometry_msgs", "nav_msgs", "sensor_msgs", "std_msgs", "visualization_msgs"),
    "common_interfaces": _STANDARD,
    "common_msgs": _STANDARD,
    "control_msgs": ("actionlib_msgs", "geometry_msgs", "sensor_msgs", "std_msgs", "trajectory_msgs"),
    "controller_manager": ("controller_manager_msgs",),
    "costmap_2d": ("geometry_msgs", "map_msgs", "nav_msgs", "sensor_msgs", "std_msgs", "visualization_msgs"),
    "cv_bridge": ("sensor_msgs",),
    "diagnostic_updater": ("diagnostic_msgs", "std_msgs"),
    "gazebo_msgs": ("geometry_msgs", "sensor_msgs", "std_msgs", "std_srvs", "trajectory_msgs"),
    "gazebo_ros": ("gazebo_msgs", "geometry_msgs", "std_msgs", "std_srvs"),
    "geometry_msgs": ("std_msgs",),
    "image_transport": ("sensor_msgs",),
    "laser_geometry": ("sensor_msgs",),
    "map_server": ("nav_msgs",),
    "move_base": ("geometry_msgs", "move_base_msgs", "nav_msgs", "std_srvs", "visualization_msgs"),
    "move_base_msgs": ("actionlib_msgs", "geometry_msgs"),
    "nav2_msgs": ("action_msgs", "geographic_msgs", "geometry_msgs", "nav_msgs", "std_msgs"),
    "nav2_bringup": ("navigation2",),
    "nav_core": ("geometry_msgs", "std_msgs"),
    "navigation2": ("nav2_msgs",),
    "nav_msgs": ("actionlib_msgs", "geometry_msgs", "std_msgs"),
    "pcl_conversions": ("sensor_msgs", "std_msgs"),
    "pcl_ros": ("geometry_msgs", "sensor_msgs", "std_msgs"),
    "ros_gz": ("ros_gz_interfaces",),
    "ros_gz_bridge": ("ros_gz_interfaces",),
    "ros_ign": ("ros_ign_interfaces",),
    "ros_ign_bridge": ("ros_ign_interfaces",),
    "rclcpp": ("builtin_interfaces", "rcl_interfaces", "rosgraph_msgs", "statistics_msgs"),
    "rclpy": ("action_msgs", "builtin_interfaces", "rcl_interfaces", "rosgraph_msgs"),
    "roscpp": ("rosgraph_msgs", "std_msgs"),
    "rospy": ("rosgraph_msgs", "std_msgs"),
    "sensor_msgs": ("geometry_msgs", "std_msgs"),
    "simple_grasping": ("geometry_msgs", "grasping_msgs", "moveit_msgs", "sensor_msgs", "shape_msgs"),
    "spacenav_node": ("geometry_msgs", "sensor_msgs"),
    "tf": ("geometry_msgs", "sensor_msgs", "std_msgs"),
    "tf2_geometry_msgs": ("geometry_msgs",),
    "tf2_ros": ("geometry_msgs", "sensor_msgs", "std_msgs"),
    "trajectory_msgs": ("std_msgs",),
    "visualization_msgs": ("geometry_msgs", "sensor_msgs", "std_msgs"),
}
"""Of packages that many depend on what their manifests export or run with, as far as it is interfaces."""
_INTERFACES = ("_msgs", "_interfaces")
_DECLARED = frozenset({"depend", "build", "build_export", "exec", "run"})
_HANDED_ON = frozenset({"depend", "build_export", "exec", "run"})


def brought_by(package: Package, wanted: str, packages: tuple[Package, ...]) -> str:
    """Return the declared dependency by which another package comes along; empty where none does.

    Args:
        package: whose manifest does not name it.
        wanted: name of the other package.
        packages: of the workspace, whose own dependencies are known.
    """
    own = {one.name: one for one in packages}
    for first in dict.fromkeys(one.name for one in package.dependencies if one.kind in _DECLARED):
        seen: set[str] = set()
        waiting = [first]
        while waiting:
            name = waiting.pop()
            if name == wanted:
                return first
            if name in seen or name == package.name:
                continue
            seen.add(name)
            waiting += _KNOWN.get(name, ())
            waiting += [one.name for one in own[name].dependencies if one.kind in _HANDED_ON] if name in own else []
    return ""


def may_be_brought_by(package: Package, wanted: str, packages: tuple[Package, ...]) -> str:
    """Return a declared package of which nothing is known, and which may have another one among its own.

    That is an interface package where many use the other one, or one of the same family: of `arm`, `arm_driver` and the
    like where `arm_msgs` is wanted.

    Args:
        package: whose manifest does not name the other one.
        wanted: name of the other one.
        packages: of the workspace, whose own dependencies are known.
    """
    known = {*_KNOWN, *_STANDARD, *(one.name for one in packages)}
    declared = (one.name for one in package.dependencies if one.kind in _DECLARED and one.name not in known)
    if wanted in _STANDARD:
        return next((name for name in declared if name.endswith(_INTERFACES)), "")
    family, _, last = wanted.rpartition("_")
    if f"_{last}" not in _INTERFACES or not family:
        return ""
    return next((name for name in declared if name == family or name.startswith(f"{family}_")), "")
