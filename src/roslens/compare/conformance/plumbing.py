"""Endpoints that every node or a tool has: they connect everything, and carry no information on the system."""

from __future__ import annotations

import re

from roslens.compare.conformance.claim import NODE, Claim

_TOPICS = frozenset({"/rosout", "/rosout_agg", "/parameter_events", "/clock_reset"})
_OWN = frozenset(
    {
        "/get_loggers", "/set_logger_level", "/describe_parameters", "/get_parameters", "/get_parameter_types",
        "/list_parameters", "/set_parameters", "/set_parameters_atomically", "/get_type_description",
        "/get_logger_levels", "/set_logger_levels",
    }
)  # fmt: skip
"""Services of a node, below its name."""
_UNLISTED = frozenset({"start_type_description_service", "use_sim_time", "/rosdistro", "/rosversion", "/run_id"})
"""Parameters that every node of ROS 2 has, or that the launcher of ROS 1 sets."""
_LAUNCHER = re.compile(r"/roslaunch/")
_TOOLS = (
    (re.compile(r"/launch_ros_\d+\Z"), "the launch system itself"),
    (re.compile(r"/_?ros2cli(_daemon)?_"), "the ros2 command"),
    (re.compile(r"/(rosbag2_recorder|record_\d+|rosbag2_player|play_\d+)"), "a recorder or player of bags"),
    (re.compile(r"/rosgraph_monitor\Z"), "a monitor of the graph"),
    (re.compile(r"/rosout\Z"), "the log of ROS 1"),
    (re.compile(r"/(rostopic|rosnode|rosservice)_\d+_\d+"), "a command of ROS 1"),
    (re.compile(r"/(rviz2?|rqt_gui(_py_node)?|rqt_\w+)(_\d+)*\Z"), "a tool that people look with"),
    (re.compile(r"/(_?roslens)_"), "roslens"),
    (re.compile(r"/transform_listener_impl_[0-9a-f]+\Z"), "a listener for transforms, part of another node"),
)


def plumbing(claim: Claim) -> bool:
    """Return whether every node of its kind has the claimed endpoint."""
    if claim.implicit:
        return True
    if claim.kind == "parameter":
        return claim.name in _UNLISTED or bool(_LAUNCHER.match(claim.name))
    if claim.kind == NODE:
        return False
    name = claim.name
    below = name[len(claim.node) :] if claim.node and name.startswith(f"{claim.node}/") else ""
    return name in _TOPICS or below in _OWN or "/_action/" in name


def tool(node: str) -> str:
    """Return what a node is that no robot's source starts, in words; empty of any other."""
    return next((words for pattern, words in _TOOLS if pattern.match(node)), "")
