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
from roslens.source.rules.node.timing.unit_of_name import SLOWEST, SPOKEN, is_rate, unit_of_name, value_of_name
from roslens.source.rules.rule import ROS_CPP, FileRule

_TAKES: Mapping[str, str] = {
    "ros::Duration": "s",
    "ros::WallDuration": "s",
    "rclcpp::Duration::from_seconds": "s",
    "rclcpp::Duration::from_nanoseconds": "ns",
    "std::chrono::duration<double>": "s",
    "std::chrono::duration<float>": "s",
    "std::chrono::duration<double, std::milli>": "ms",
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
_PLAIN = re.compile(r"(?:static_cast<[\w: ]+>\()?((?:\w+(?:\.|->|::))*\w+)\)?")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a variable whose name ends in a unit, given as it is to what takes another one."""
    name = whole_name(node)
    takes = _TAKES.get(view.text(name))
    given = made_with(node) or ()
    if takes is None or len(given) != 1:
        return
    plain = _PLAIN.fullmatch(view.text(given[0]))
    unit = unit_of_name(plain[1]) if plain is not None else ""
    if not unit or unit == takes:
        return
    last = plain[1] if plain is not None else ""
    certainty = of_rate(last, takes, view)
    if certainty is None:
        return
    expected = f"`1.0 / {last}`" if (unit, takes) == ("Hz", "s") else "a conversion"
    yield view.hit(
        "node.duration_unit",
        given[0],
        f"`{view.text(name)}` takes {SPOKEN[takes]}, and `{last}` is in {SPOKEN[unit]} by its name; expected "
        f"{expected}, or a name that says the unit",
        certainty=certainty,
    )


def of_rate(name: str, takes: str, view: FileView) -> Certainty | None:
    """Return how certain it is that a name says its unit; None where it is called a rate and is a period.

    A period is often called a rate: its first value tells.
    """
    if not is_rate(name):
        return Certainty.LIKELY
    value = value_of_name(name, view.content)
    if value is not None and value < SLOWEST and takes == "s":
        return None
    return Certainty.LIKELY if value is not None and takes == "s" else Certainty.HEURISTIC


RULE = FileRule(
    id="node.duration_unit",
    title="Duration in another unit than its name says",
    finds="A variable whose name ends in a unit (`timeout_ms`, `periodSec`, `rate_hz`) or in `rate` or `frequency`, "
    "given as it is to a duration or rate that takes another unit: `ros::Duration(timeout_ms)`, "
    "`ros::Duration(loop_rate)`, `std::chrono::milliseconds(timeout_sec)`. Convert it. A period that is called a rate "
    "is none, if its first value in the file is less than 8; where the file has no value, or it counts milliseconds, "
    "a rate is a note.",
    why="A timeout of 500 ms is one of 500 s, and one of 2 s is over after 2 ms: the robot waits for minutes, or gives "
    "up before anything can have happened. A rate of 10 Hz taken for a period is once in 10 s.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <ros/ros.h>\nvoid f(int timeout_ms) { ros::Duration(timeout_ms).sleep(); }\n",
    good="#include <ros/ros.h>\nvoid f(int timeout_ms) { ros::Duration(timeout_ms / 1000.0).sleep(); }\n",
    syntax="cpp",
    anchors=(*(name for name in _TAKES if "<" not in name), "std::chrono::duration"),
    mentions=ROS_CPP,
    found=found,
)
