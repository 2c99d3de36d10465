"""Rule ``node.transform_at_now_python``: a look-up of a transform for this very moment, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_NOW = re.compile(r"\bnow\(\)(\.to_msg\(\))?$")
_WAITS = re.compile(rb"waitForTransform|can_?[tT]ransform|wait_for_transform")
_WITHOUT_LIMIT = 3


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look-up at the present time with nothing that waits."""
    call, function = call_at(node), function_around(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) != _WITHOUT_LIMIT or not _NOW.search(view.text(given[2])):
        return
    body = body_of(function) if function is not None else None
    start = body.start_byte if body is not None else 0
    if "timeout" not in keywords(call, view) and not _WAITS.search(view.code[start : call.start_byte]):
        yield view.hit(
            "node.transform_at_now_python",
            given[2],
            f"transform at `{view.text(given[2])}` without a timeout: nothing is known of this moment yet, so it "
            "raises; "
            "expected the newest (time 0) or `timeout=`",
        )


RULE = FileRule(
    id="node.transform_at_now_python",
    title="Transform of this very moment, without a timeout (Python)",
    finds="`lookup_transform(..., now())` without a timeout. Ask for the newest (`Time()`), for the stamp of a "
    "message, or "
    "give a timeout.",
    why="Transforms arrive later than they are valid: of now there is none yet, and the look-up raises an "
    "extrapolation, "
    "nearly always.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms", "time"),
    bad="import rospy\nt = buffer.lookup_transform('map', 'base', rospy.Time.now())\n",
    good="import rospy\nt = buffer.lookup_transform('map', 'base', rospy.Time())\n",
    syntax="python",
    anchors=("lookup_transform", "lookupTransform"),
    mentions=ROS_PYTHON,
    found=found,
)
