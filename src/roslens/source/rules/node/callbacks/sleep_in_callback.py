"""Rule ``node.sleep_in_callback``: a callback that sleeps holds up all others of its executor."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import arguments, call_at, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_SLEEPERS = re.compile(r"Duration|Rate|rate|loop", re.ASCII)

_SHORT = re.compile(r"\b(?:micro|nano)seconds|milliseconds\(\d\)|\b\d ?ms\b|\busleep\(\d{1,4}\)")
"""Sleeps shorter than the period of a usual control loop."""


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
        )


RULE = FileRule(
    id="node.sleep_in_callback",
    title="Sleep in a callback",
    finds="A callback of a subscription, timer, service or action that sleeps. Let a timer go on later instead.",
    why="A node's executor has one thread by default: while a callback sleeps, no message, no timer and no stop "
    "command is looked at, and queues run over.",
    severity=Severity.NOTE,
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
