"""Rule ``node.duration_unit``: a number in one unit, given to what takes another."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import whole_name
from roslens.source.rules.cpp_flow.declared_with import made_with
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_TAKES: Mapping[str, str] = {
    "ros::Duration": "s",
    "ros::WallDuration": "s",
    "rclcpp::Duration::from_seconds": "s",
    "rclcpp::Duration::from_nanoseconds": "ns",
    "std::chrono::seconds": "s",
    "std::chrono::milliseconds": "ms",
    "std::chrono::microseconds": "us",
    "std::chrono::nanoseconds": "ns",
    "chrono::seconds": "s",
    "chrono::milliseconds": "ms",
    "chrono::microseconds": "us",
    "chrono::nanoseconds": "ns",
    "ros::Rate": "Hz",
    "rclcpp::Rate": "Hz",
    "rclcpp::WallRate": "Hz",
}
"""The unit of the one number that a type or function takes."""
_SPOKEN: Mapping[str, str] = {
    "s": "seconds",
    "ms": "milliseconds",
    "us": "microseconds",
    "ns": "nanoseconds",
    "Hz": "hertz",
}
_ENDS = re.compile(
    r"(?:_|\b)(?:(?P<ms>ms|msecs?|millis|milliseconds?|milli_?secs?)|(?P<us>us|usecs?|micros|microseconds?)"
    r"|(?P<ns>ns|nsecs?|nanos|nanosecs?|nanoseconds?)|(?P<s>s|secs?|seconds?)|(?P<Hz>hz|Hz))_?$"
    r"|[a-z](?:(?P<cms>Ms|MSec|Msecs?|Millis|MilliSecs?|Milliseconds?|MilliSeconds?)|(?P<cus>Us|USec|Micros|Microseconds?)"
    r"|(?P<cns>Ns|NSec|Nanos|Nanoseconds?)|(?P<cs>Sec|Secs|Seconds)|(?P<cHz>Hz))_?$"
)
_PLAIN = re.compile(r"(?:static_cast<[\w: ]+>\()?((?:\w+(?:\.|->|::))*\w+)\)?")
_OF_A_TIME = frozenset(("count", "nanoseconds", "seconds", "nanosec", "nsec", "sec"))


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a variable whose name ends in a unit, given as it is to what takes another one."""
    name = whole_name(node)
    takes = _TAKES.get(view.text(name))
    given = made_with(node) or ()
    if takes is None or len(given) != 1:
        return
    plain = _PLAIN.fullmatch(view.text(given[0]))
    unit = _unit_of(plain[1]) if plain is not None else ""
    if not unit or unit == takes:
        return
    last = plain[1] if plain is not None else ""
    yield view.hit(
        "node.duration_unit",
        given[0],
        f"`{view.text(name)}` takes {_SPOKEN[takes]}, and `{last}` is in {_SPOKEN[unit]} by its name; expected a "
        "conversion, or a name that says the unit",
    )


def _unit_of(name: str) -> str:
    """Return the unit in which a name ends; empty where it ends in none."""
    last = re.split(r"\.|->|::", name)[-1]
    if last in _OF_A_TIME or len(last.strip("_")) <= 2:
        return ""
    match = _ENDS.search(last)
    if match is None:
        return ""
    return next(key.removeprefix("c") for key, value in match.groupdict().items() if value is not None)


RULE = FileRule(
    id="node.duration_unit",
    title="Duration in another unit than its name says",
    finds="A variable whose name ends in a unit (`timeout_ms`, `periodSec`, `rate_hz`), given as it is to a duration "
    "or rate that takes another: `ros::Duration(timeout_ms)`, `std::chrono::milliseconds(timeout_sec)`. Convert it.",
    why="A timeout of 500 ms is one of 500 s, and one of 2 s is over after 2 ms: the robot waits for minutes, or gives "
    "up before anything can have happened.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nvoid f(int timeout_ms) { ros::Duration(timeout_ms).sleep(); }\n",
    good="#include <ros/ros.h>\nvoid f(int timeout_ms) { ros::Duration(timeout_ms / 1000.0).sleep(); }\n",
    syntax="cpp",
    anchors=(*_TAKES,),
    mentions=ROS_CPP,
    found=found,
)
