"""Names that distributions of ROS deprecated or removed, by the changelogs of their packages."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import cast

import msgspec
from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.calls import whole_name
from roslens.source.rules.file_view import FileView, all_above
from roslens.source.rules.hit import Hit


class Deprecated(msgspec.Struct, frozen=True, array_like=True):
    """A name, or the path of a header, that should not be used any more.

    Attributes:
        name: as it stands in the code.
        since: the distribution that deprecated it.
        instead: what to write.
        gone: the distribution that removed it; empty where it is still there.
        alike: ``instead`` takes its place as it is.
    """

    name: str
    since: str
    instead: str
    gone: str = ""
    alike: bool = False


CPP_ROS2 = (
    Deprecated("set_on_parameters_set_callback", "Foxy", "add_on_set_parameters_callback", "Galactic"),
    Deprecated("rclcpp::executor::FutureReturnCode", "Foxy", "rclcpp::FutureReturnCode", "Galactic", alike=True),
    Deprecated("rclcpp::executor::ExecutorArgs", "Foxy", "rclcpp::ExecutorOptions", "Galactic", alike=True),
    Deprecated("rclcpp::executor::Executor", "Foxy", "rclcpp::Executor", "Galactic", alike=True),
    Deprecated("rclcpp::callback_group::CallbackGroup", "Foxy", "rclcpp::CallbackGroup", "Galactic", alike=True),
    Deprecated(
        "rclcpp::callback_group::CallbackGroupType", "Foxy", "rclcpp::CallbackGroupType", "Galactic", alike=True
    ),
    Deprecated(
        "rclcpp::executors::StaticSingleThreadedExecutor",
        "Kilted",
        "rclcpp::executors::SingleThreadedExecutor",
    ),
)
"""Sources: changelog of rclcpp 0.9.0, 1.1.0, 5.1.0, 29.0.0."""

HEADERS_ROS2 = (
    Deprecated(
        "tf2_geometry_msgs/tf2_geometry_msgs.h", "Humble", "tf2_geometry_msgs/tf2_geometry_msgs.hpp", alike=True
    ),
    Deprecated("tf2_eigen/tf2_eigen.h", "Humble", "tf2_eigen/tf2_eigen.hpp", alike=True),
    Deprecated("tf2_sensor_msgs/tf2_sensor_msgs.h", "Humble", "tf2_sensor_msgs/tf2_sensor_msgs.hpp", alike=True),
    Deprecated("tf2_kdl/tf2_kdl.h", "Humble", "tf2_kdl/tf2_kdl.hpp", alike=True),
    Deprecated("tf2_bullet/tf2_bullet.h", "Humble", "tf2_bullet/tf2_bullet.hpp", alike=True),
)
"""Source: geometry2, which warns of each «This header is obsolete» since Humble."""

PYTHON_ROS2 = (
    Deprecated("set_parameters_callback", "Foxy", "add_on_set_parameters_callback", "Galactic"),
    Deprecated("RMW_QOS_POLICY_RELIABILITY_RELIABLE", "Galactic", "ReliabilityPolicy.RELIABLE"),
    Deprecated("RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT", "Galactic", "ReliabilityPolicy.BEST_EFFORT"),
    Deprecated("RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL", "Galactic", "DurabilityPolicy.TRANSIENT_LOCAL"),
    Deprecated("RMW_QOS_POLICY_DURABILITY_VOLATILE", "Galactic", "DurabilityPolicy.VOLATILE"),
    Deprecated("RMW_QOS_POLICY_HISTORY_KEEP_LAST", "Galactic", "HistoryPolicy.KEEP_LAST"),
    Deprecated("RMW_QOS_POLICY_HISTORY_KEEP_ALL", "Galactic", "HistoryPolicy.KEEP_ALL"),
)
"""Sources: changelog of rclpy 0.9.0, 1.2.1."""

CPP_ROS1 = (
    Deprecated("PLUGINLIB_DECLARE_CLASS", "Indigo", "PLUGINLIB_EXPORT_CLASS", "Melodic"),
    Deprecated("PLUGINLIB_REGISTER_CLASS", "Indigo", "PLUGINLIB_EXPORT_CLASS", "Melodic"),
)
HEADERS_ROS1 = (
    Deprecated("pluginlib/class_list_macros.h", "Melodic", "pluginlib/class_list_macros.hpp", alike=True),
    Deprecated("pluginlib/class_loader.h", "Melodic", "pluginlib/class_loader.hpp", alike=True),
)
PYTHON_ROS1 = (Deprecated("roslib.load_manifest", "Groovy", "no call: catkin sets the paths"),)
"""Sources: changelog of pluginlib 1.10, 1.12; roslib."""


def find(node: Node, view: FileView, rule: str, table: tuple[Deprecated, ...]) -> Iterator[Hit]:
    """Yield a hit where a node, or the name it is part of, is one of a table."""
    if node.type == "string_content" or "string" in node.type:
        name = view.text(node).strip('<>"')
        place: Node = node
    else:
        place = whole_name(node)
        name = view.text(place)
    if _is_chosen(node, view) or _is_defined(name, view):
        return
    row = next((row for row in table if _is_meant(name, row.name, alone=place is node)), None)
    if row is None:
        return
    gone = f" and removed in {row.gone}" if row.gone else ""
    message = f"`{row.name}` is deprecated since {row.since}{gone}; expected `{row.instead}`"
    # What is still there in every distribution may be all that the oldest one that is built for has.
    certainty = Certainty.HEURISTIC if rule.startswith("node.deprecated_ros2") and not row.gone else None
    yield view.hit(rule, place, message, edits=_renamed(place, row, view), certainty=certainty)


def _is_meant(name: str, deprecated: str, *, alone: bool) -> bool:
    """Return whether a name is a deprecated one, a member of it, or, behind an object, a method of that name."""
    if name == deprecated or name.startswith(f"{deprecated}::"):
        return True
    return not alone and name.endswith((f".{deprecated}", f"->{deprecated}"))


def _renamed(place: Node, row: Deprecated, view: FileView) -> tuple[Edit, ...]:
    at = view.content.find(row.name.encode(), place.start_byte, place.end_byte) if row.alike else -1
    return view.edits((at, at + len(row.name), row.instead)) if at >= 0 else ()


def _is_defined(name: str, view: FileView) -> bool:
    """Tell whether the file defines a class or its constructor: who deprecates a name has to keep it for a while."""
    last = re.split(r"::|->|\.", name)[-1]
    key = ("defined", last)
    found = view.kept.get(key)
    if found is None:
        word = re.escape(last.encode())
        defined = rb"\b(?:class|struct)\s+(?:\w+\s+)?%s\s*(?:final\s*)?[:{]|\b%s\s*::\s*~?%s\s*\("
        found = view.kept[key] = re.search(defined % (word, word, word), view.code) is not None
    return cast("bool", found)


def _is_chosen(node: Node, view: FileView) -> bool:
    """Tell whether the preprocessor chooses, by distribution or by what there is, whether a node is compiled."""
    for one in all_above(node):
        if one.type.startswith("preproc_if"):
            text = view.source[one.start_byte : one.end_byte]
            if (
                b"#else" in text
                or b"#elif" in text
                or b"DISTRO" in text
                or b"ROS_VERSION" in text
                or b"has_include" in text
            ):
                return True
    return False
