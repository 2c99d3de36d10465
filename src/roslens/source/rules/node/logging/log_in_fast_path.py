"""Rule ``node.log_in_fast_path``: a log line for each message or tick."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at, function_around, is_conditional, statement_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.messages.stamped import FAST
from roslens.source.rules.rule import ROS_CPP, FileRule

_LEVELS = ("INFO", "WARN", "ERROR", "FATAL")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a log call that every run of a callback of a stream reaches."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or is_conditional(call, function):
        return
    body = function.child_by_field_name("body")
    if body is None or statement_around(call).parent != body:
        return
    before = view.code[body.start_byte : call.start_byte]
    if b"return" in before or b"cancel()" in view.code[body.start_byte : body.end_byte]:
        return
    if not _is_fast(function, view):
        return
    callback = callback_around(call, view, of_stream=True)
    if callback is not None:
        yield view.hit(
            "node.log_in_fast_path",
            call,
            f"`{view.text(node)}` each time that {spoken(callback)} runs; expected `{view.text(node)}_THROTTLE` or "
            "DEBUG",
            callback=callback,
        )


def _is_fast(function: Node, view: FileView) -> bool:
    """Tell whether a callback is of a timer or of messages that come often, by its parameters."""
    body = function.child_by_field_name("body")
    head = view.code[function.start_byte : body.start_byte if body is not None else function.end_byte].decode("latin-1")
    parameters = head.rpartition(")")[0].rpartition("(")[2].strip()
    return (
        not parameters
        or "TimerEvent" in parameters
        or any(word in FAST for word in re.findall(r"\w+", _plain(parameters)))
    )


def _plain(parameters: str) -> str:
    """Return parameters without what roscpp appends to the name of a type for its pointers."""
    return re.sub(r"(Const)?Ptr\b", "", parameters)


RULE = FileRule(
    id="node.log_in_fast_path",
    title="Log line for every message",
    finds="INFO or above, not throttled and under no condition, in a callback of a subscription or timer. Throttle "
    "it, log a "
    "change, or use DEBUG.",
    why="A hundred lines a second hide the one that matters, fill the disk of the robot, and take more time than the "
    "rest of "
    "the callback.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("logging", "performance"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::on_imu(const Imu::SharedPtr imu) { RCLCPP_INFO(get_logger(), "imu"); }
void Arm::start() { sub_ = create_subscription<Imu>("imu", 10, std::bind(&Arm::on_imu, this, _1)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::on_imu(const Imu::SharedPtr imu) { RCLCPP_INFO_THROTTLE(get_logger(), *get_clock(), 1000, "imu"); }
void Arm::start() { sub_ = create_subscription<Imu>("imu", 10, std::bind(&Arm::on_imu, this, _1)); }
""",
    syntax="cpp",
    anchors=tuple(
        f"{start}_{level}{end}" for start in ("RCLCPP", "ROS") for level in _LEVELS for end in ("", "_STREAM")
    ),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
