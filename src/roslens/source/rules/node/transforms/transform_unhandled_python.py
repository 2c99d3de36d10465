"""Rule ``node.transform_unhandled_python``: a look-up of a transform that nobody catches, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_ASKS_FIRST = re.compile(rb"can_transform|canTransform|waitForTransform|wait_for_transform")
_LOOKS_UP = re.compile(rb"\.lookup_?[tT]ransform\(")
_FEWEST = 3


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look-up outside of ``try``, in a callback that neither asks nor waits before."""
    call, function = call_at(node), function_around(node)
    if call is None or len(arguments(call)) < _FEWEST or is_handled(call):
        return
    body = body_of(function) if function is not None else None
    start = body.start_byte if body is not None else 0
    # rospy hands what a service or action raises on to whoever asked.
    callback = callback_around(call, view, of_stream=not view.mentions((b"rclpy",)))
    before = view.code[start : call.start_byte]
    # The first look-up of a function raises for those behind it.
    if callback is not None and not _ASKS_FIRST.search(before) and not _LOOKS_UP.search(before):
        yield view.hit(
            "node.transform_unhandled_python",
            call,
            f"`{view.short(call, 80)}` outside of `try`: it raises until the transform is known; expected "
            "`except TransformException`",
            callback=callback,
        )


RULE = FileRule(
    id="node.transform_unhandled_python",
    title="Unhandled exception of a transform look-up (Python)",
    finds="`lookup_transform` outside of `try`, in a callback that neither asks `can_transform` nor waits before; of "
    "several in a function the first one. "
    "Catch `TransformException` and go on without. Handlers of services and actions of rospy are left out: the caller "
    "gets it.",
    why="At start, and whenever a localisation is late, the transform is not there, and the look-up raises: a node of "
    'rclpy ends. rospy logs "bad callback" for a subscription and goes on without what the rest of the callback does; '
    "a timer of rospy ends.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms", "exceptions"),
    bad="import rclpy\nnode.create_timer(1.0, tick)\ndef tick(self):\n    t = self.buffer.lookup_transform('map', "
    "'base', Time())\n",
    good="""import rclpy
node.create_timer(1.0, tick)
def tick(self):
    try:
        t = self.buffer.lookup_transform('map', 'base', Time())
    except TransformException:
        return
""",
    syntax="python",
    anchors=("lookup_transform", "lookupTransform"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
