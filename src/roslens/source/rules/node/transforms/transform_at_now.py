"""Rule ``node.transform_at_now``: a look-up of a transform for this very moment."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_NOW = re.compile(r"\bnow\(\)(\.to_msg\(\))?$")
_WAITS = re.compile(rb"waitForTransform|canTransform")
_WITHOUT_LIMIT = (3, 4)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look-up at the present time with nothing that waits."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    given = arguments(call) if call is not None else ()
    if call is None or body is None or len(given) not in _WITHOUT_LIMIT or not _NOW.search(view.text(given[2])):
        return
    if len(given) == _WITHOUT_LIMIT[1] and not re.search(r"[tT]ransform|^(?:\w*_)?(?:tf|t)_?$", view.text(given[3])):
        return
    if not _WAITS.search(view.code[body.start_byte : call.start_byte]):
        yield view.hit(
            "node.transform_at_now",
            given[2],
            f"transform at `{view.text(given[2])}` without a timeout: nothing is known of this moment yet, so it "
            "throws; "
            "expected the newest (time 0) or a timeout",
        )


RULE = FileRule(
    id="node.transform_at_now",
    title="Transform of this very moment, without a timeout",
    finds="`lookupTransform(..., now())` without a timeout. Ask for the newest (`tf2::TimePointZero`, "
    "`ros::Time(0)`), for "
    "the stamp of a message, or give a timeout.",
    why="Transforms arrive later than they are valid: of now there is none yet, and the look-up throws an "
    "extrapolation, "
    "nearly always.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("transforms", "time"),
    bad='#include <rclcpp/rclcpp.hpp>\nvoid Arm::tick() { t_ = buffer_->lookupTransform("map", "base", now()); }\n',
    good="#include <rclcpp/rclcpp.hpp>\nvoid Arm::tick() { t_ = buffer_->lookupTransform(map, base, now(), 100ms); }\n",
    syntax="cpp",
    anchors=("lookupTransform",),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
