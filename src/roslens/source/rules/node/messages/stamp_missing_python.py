"""Rule ``node.stamp_missing_python``: a message whose header nobody fills, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.messages.stamped import COMMANDS, STAMPED
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_NAMES = "|".join(sorted(STAMPED))


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``publish(m)`` of a local message that is made in the function, whose header is never touched."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    given = arguments(call) if call is not None else ()
    if call is None or body is None or len(given) != 1 or given[0].type != "identifier":
        return
    name = re.escape(view.text(given[0]).encode())
    code = view.code[body.start_byte : call.end_byte]
    made = re.search(rb"(?<![\w.])" + name + rb"\s*=\s*(?:\w+\.)*(" + _NAMES.encode() + rb")\(\s*\)", code)
    if made is None or len(re.findall(rb"(?<![\w.])" + name + rb"\s*=(?!=)", code)) > 1:
        return
    uses = re.findall(rb"(?<![\w.])" + name + rb"\b(\.(?!header\b)\w)?", code[made.end() :])
    if len(uses) < 2 or sum(not one for one in uses) > 1:
        return
    kind = made[1].decode()
    yield view.hit(
        "node.stamp_missing_python",
        call,
        f"`{view.text(given[0])}` ({kind}) is published and its header never set: time 0, no frame; expected "
        "`header.stamp` and `header.frame_id`",
        certainty=Certainty.HEURISTIC if kind in COMMANDS else None,
    )


RULE = FileRule(
    id="node.stamp_missing_python",
    title="Message published without its header (Python)",
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
    bad="import rospy\ndef tick():\n    r = Range()\n    r.range = 1.0\n    pub.publish(r)\n",
    good="import rospy\ndef tick():\n    r = Range()\n    r.header.stamp = rospy.Time.now()\n    pub.publish(r)\n",
    syntax="python",
    anchors=("publish",),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
