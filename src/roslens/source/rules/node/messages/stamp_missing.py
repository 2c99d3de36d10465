"""Rule ``node.stamp_missing``: a message whose header nobody fills."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.messages.stamped import STAMPED
from roslens.source.rules.rule import ROS_CPP, FileRule

_NAMES = "|".join(sorted(STAMPED))
_DECLARED = re.compile(rb"_msgs::(?:msg::)?(?:" + _NAMES.encode() + rb")\s+([\w\x80-\xff]+)")
_MEMBERS = rb"\s*(\.|->)\s*(?!header\b)\w"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``publish(m)`` of a local message that is made in the function, whose header is never touched."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    given = arguments(call) if call is not None else ()
    if call is None or body is None or len(given) != 1 or given[0].type != "identifier":
        return
    code = view.code[body.start_byte : call.end_byte]
    # A pattern with the name in it is compiled for each name; most are no local messages with a header.
    if (word := view.text(given[0]).encode()) not in _DECLARED.findall(code):
        return
    name = re.escape(word)
    made = re.search(
        rb"(?:^|[;{}])\s*\w+_msgs::(?:msg::)?(" + _NAMES.encode() + rb")\s+" + name + rb"\s*(\(\s*\)|\{\s*\})?\s*;",
        code,
    )
    if made is None or len(re.findall(rb"_msgs::[\w:]+\s+" + name + rb"\b", code)) > 1:
        return
    uses = re.findall(rb"\b" + name + rb"\b(" + _MEMBERS + rb")?", code[made.end() :])
    # The last use is the argument of `publish`; any other that touches no member may fill it.
    if len(uses) < 2 or sum(not one[0] for one in uses) > 1:
        return
    kind = made[1].decode()
    yield view.hit(
        "node.stamp_missing",
        call,
        f"`{view.text(given[0])}` ({kind}) is published and its header never set: time 0, no frame; expected "
        "`header.stamp` and `header.frame_id`",
    )


RULE = FileRule(
    id="node.stamp_missing",
    title="Message published without its header",
    finds="A message with a header that a function makes, fills and publishes without touching the header. Set the "
    "stamp and "
    "the frame.",
    why="Whoever transforms, filters or records it looks at 1970 in a frame without a name: it is dropped, or taken "
    "for the "
    "newest of all.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("messages", "time"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { sensor_msgs::msg::Range range; range.range = 1.0; pub_->publish(range); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { sensor_msgs::msg::Range range; range.header.stamp = now(); range.range = 1.0; pub_->publish(range); }
""",
    syntax="cpp",
    anchors=("publish",),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
