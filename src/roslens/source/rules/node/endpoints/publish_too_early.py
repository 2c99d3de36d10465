"""Rule ``node.publish_too_early``: a message that is published before anybody can be connected."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import (
    arguments,
    body_of,
    call_at,
    function_around,
    is_conditional,
    is_static,
    loop_around,
    statement_around,
)
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_TIME_PASSES = re.compile(
    rb"sleep|[sS]pin|[wW]ait|getNumSubscribers|get_subscription_count|transient_local|TransientLocal|TRANSIENT|[lL]atch|"
    rb"lookup|\bcall\b|subscribe|create_subscription",
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first ``publish`` in the function that made the publisher, where nothing waits between."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    if call is None or call.parent is None or body is None:
        return
    given = arguments(call)
    if len(given) > 2 and view.text(given[-1]) == "true":
        return
    made = call.parent
    name = view.text(made.child_by_field_name("declarator") or made.child_by_field_name("left"))
    if not name or "[" in name or (function is not None and is_conditional(call, function)) or is_static(call, view):
        return
    start = statement_around(call).end_byte
    match = _published_once(name, view.code[start : body.end_byte])
    if match is None or _TIME_PASSES.search(view.code[body.start_byte : start + match.end()]):
        return
    place = view.node_at(start + match.start(2), start + match.end(2))
    if place is not None and function_around(place) == function and loop_around(place) == loop_around(call):
        yield view.hit(
            "node.publish_too_early",
            place.parent or place,
            f"`{name}` publishes in the function that makes it, before any subscription is matched: the message is "
            "lost; expected it later, or transient local (latched)",
        )


def _published_once(name: str, code: bytes) -> re.Match[bytes] | None:
    """Return where a publisher publishes, None where it does not or does again: later, or by a timer."""
    if b"publish" not in code or name.encode() not in code:
        return None
    published = re.compile(rb"(?<![\w.>])" + re.escape(name.encode()) + rb"\s*(\.|->)\s*(publish)\b")
    match = published.search(code)
    return None if match is None or published.search(code[match.end() :]) else match


RULE = FileRule(
    id="node.publish_too_early",
    title="Message published right after its publisher was made",
    finds="A publisher and its first `publish` in one function, with no wait between; one that publishes "
    "again is let be. "
    "Publish later, wait for "
    "subscriptions, or make it transient local (ROS 2) or latched (ROS 1).",
    why="Subscriptions are matched over the network after the call that makes the publisher: what is published at once "
    "reaches nobody, on most days. Where a callback makes the publisher anew, that is each message; rospy alone, whose "
    "publishers on one topic share connections that stay, loses only the very first.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("endpoints",),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { pub_ = create_publisher<State>("state", 10); pub_->publish(State()); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") {
  pub_ = create_publisher<State>("state", rclcpp::QoS(1).transient_local());
  pub_->publish(State());
}
""",
    syntax="cpp",
    anchors=("advertise", "create_publisher"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
