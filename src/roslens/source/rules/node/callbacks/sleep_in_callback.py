"""Rule ``node.sleep_in_callback``: a callback that sleeps holds up all others of its executor."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, runs_once, spoken
from roslens.source.rules.calls import arguments, call_at, function_around, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.meant_pause import is_meant
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_SLEEPERS = re.compile(r"Duration|Rate|rate|loop", re.ASCII)

_SHORT = re.compile(r"\b(?:micro|nano)seconds|milliseconds\(\d\)|\b\d ?ms\b|\busleep\(\d{1,4}\)")
"""Sleeps shorter than the period of a usual control loop."""

_LENGTH = re.compile(
    r"(?P<number>\d+\.?\d*)(?P<unit>s|ms|us|ns)\b"
    r"|(?P<kind>milliseconds|seconds|Duration|usleep|sleep)\((?P<given>\d+\.?\d*)\)"
)
_SECONDS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "milliseconds": 1e-3, "usleep": 1e-6}
_LONG_S = 1.0
"""Nobody waits that long for a device between two messages."""


def _is_long(call: Node, view: FileView) -> bool:
    """Return whether a sleep of a length that is written there is a long one, in a callback that runs again."""
    length = _LENGTH.search(view.text(call))
    function = function_around(call)
    if length is None or (function is not None and runs_once(function, view)):
        return False
    number = float(length["number"] or length["given"])
    return number * _SECONDS.get(length["unit"] or length["kind"], 1.0) >= _LONG_S


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that sleeps in a callback."""
    call = call_at(node)
    if call is None:
        return
    of = receiver(call)
    if of is not None and not _SLEEPERS.search(view.text(of)):
        return
    if of is None and not arguments(call):
        return
    if _SHORT.search(view.text(call)):
        return
    callback = callback_around(call, view)
    if callback is not None:
        yield view.hit(
            "node.sleep_in_callback",
            call,
            f"`{view.text(call)}` in {spoken(callback)}: its executor thread runs nothing else meanwhile; expected a "
            "timer "
            "that goes on later",
            callback=callback,
            certainty=None if _is_long(call, view) and not is_meant(call, view) else Certainty.HEURISTIC,
        )


RULE = FileRule(
    id="node.sleep_in_callback",
    title="Sleep in a callback",
    finds="A callback of a subscription, timer, service or action that sleeps. Let a timer go on later instead. A "
    "sleep of less than a second, or of a length that is computed, is a note: a device may need it. So is one that a "
    "comment or a logged message explains, that is how long a published command holds, that is one of four or more in "
    "a function (a sequence of movements), or that an example has.",
    why="A node's executor has one thread by default: while a callback sleeps, no message, no timer and no stop "
    "command is looked at, and queues run over.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "real-time"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::on_goal(const Goal::SharedPtr goal) { rclcpp::sleep_for(2s); open(); }
void Arm::start() { sub_ = create_subscription<Goal>("goal", 10, std::bind(&Arm::on_goal, this, _1)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::on_goal(const Goal::SharedPtr goal) { opening_ = create_wall_timer(2s, [this] { open(); }); }
void Arm::start() { sub_ = create_subscription<Goal>("goal", 10, std::bind(&Arm::on_goal, this, _1)); }
""",
    syntax="cpp",
    anchors=("sleep_for", "sleep_until", "usleep", "nanosleep", "sleep"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
