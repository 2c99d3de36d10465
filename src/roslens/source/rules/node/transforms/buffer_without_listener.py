"""Rule ``node.buffer_without_listener``: a buffer of transforms that is asked, and that nothing fills."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_MADE = re.compile(
    rb"(?:(\w+)\s*(?:=|\()\s*)?std::make_(?:unique|shared)<\s*tf2_ros::Buffer\s*>\s*\(|(\w+)\.reset\(\s*new\s+tf2_ros::Buffer\b"
    rb"|\btf2_ros::Buffer\s+(\w+)\s*[;({]"
)
_ASKED = re.compile(rb"\b(\w+)\s*(?:\.|->)\s*(?:lookupTransform|canTransform|transform)\s*(?:<[^;(]*>)?\(")
_FILLED = re.compile(
    rb"[lL]istener|setTransform|BufferClient|BufferServer|Monitor|CreateTimer\w*Filter|MessageFilter|getTf|tf_manager"
)


def found(root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each buffer that the file makes and asks, where it names no listener and gives the buffer to nobody."""
    if view.has(_FILLED):
        return
    asked = view.names(_ASKED)
    for match in _MADE.finditer(view.code):
        name = next((one for one in match.groups() if one), b"")
        if name not in asked or _is_given_away(name, view):
            continue
        node = root.descendant_for_byte_range(match.start(), match.end() - 1)
        if node is not None:
            yield view.hit(
                "node.buffer_without_listener",
                node,
                f"`{name.decode()}` is asked for transforms, and nothing fills it: there is no TransformListener, so "
                f"that each look-up fails; expected `tf2_ros::TransformListener` of it as a member",
            )


def _is_given_away(name: bytes, view: FileView) -> bool:
    """Return whether a buffer is an argument of something, which may fill it."""
    return (
        re.search(rb"[(,{]\s*(?:std::move\(|&|\*)?\s*%s\s*(?:\.get\(\)\s*)?[,)}]" % re.escape(name), view.code)
        is not None
    )


RULE = FileRule(
    id="node.buffer_without_listener",
    title="Buffer of transforms that nothing fills",
    finds="A `tf2_ros::Buffer` that a file makes and asks by `lookupTransform`, `canTransform` or `transform`, where "
    "no listener is named and the buffer is given to nobody else. Keep a `tf2_ros::TransformListener` of it.",
    why="A buffer does not subscribe to /tf: without a listener it stays empty, and each look-up ends with an "
    "exception or false.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms",),
    bad="""#include <tf2_ros/buffer.h>
void Arm::look() {
  tf2_ros::Buffer buffer(clock);
  pose = buffer.lookupTransform("map", "base_link", tf2::TimePointZero);
}
""",
    good="""#include <tf2_ros/buffer.h>
void Arm::look() {
  tf2_ros::Buffer buffer(clock);
  tf2_ros::TransformListener listener(buffer);
  pose = buffer.lookupTransform("map", "base_link", tf2::TimePointZero, 1s);
}
""",
    syntax="cpp",
    whole=True,
    words=("lookupTransform", "canTransform", "transform"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
