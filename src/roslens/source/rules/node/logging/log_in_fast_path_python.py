"""Rule ``node.log_in_fast_path_python``: a log line for each message or tick, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at, function_around, keywords, statement_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.messages.stamped import FAST
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_LEVELS = frozenset(("info", "warn", "warning", "error", "fatal"))


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a log call that every run of a callback of a stream reaches."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or "throttle_duration_sec" in keywords(call, view):
        return
    name = view.text(node)
    callee = view.text(call.child_by_field_name("function"))
    if name in _LEVELS and not callee.startswith(("self.get_logger()", "self.node.get_logger()", "node.get_logger()")):
        return
    body = function.child_by_field_name("body")
    if body is None or statement_around(call).parent != body or {"once", "skip_first"} & keywords(call, view).keys():
        return
    before = view.code[body.start_byte : call.start_byte]
    if b"return" in before or b"cancel()" in view.code[body.start_byte : body.end_byte]:
        return
    if not _is_fast(function, view):
        return
    callback = callback_around(call, view, of_stream=True)
    if callback is not None:
        throttled = f"rospy.{name}_throttle" if name.startswith("log") else "throttle_duration_sec="
        yield view.hit(
            "node.log_in_fast_path_python",
            call,
            f"`{callee}` each time that {spoken(callback)} runs; expected `{throttled}` or debug",
            callback=callback,
        )


def _is_fast(function: Node, view: FileView) -> bool:
    """Tell whether a callback is of a timer or of messages that come often, by its parameters."""
    words = set(re.findall(r"\w+", view.text(function.child_by_field_name("parameters")))) - {"self", "_"}
    return words <= {"event", "evt", "timer_event"} or not words.isdisjoint(FAST)


RULE = FileRule(
    id="node.log_in_fast_path_python",
    title="Log line for every message (Python)",
    finds="Info or above, not throttled and under no condition, in a callback of a subscription or timer. Throttle "
    "it, log a "
    "change, or use debug.",
    why="A hundred lines a second hide the one that matters, fill the disk of the robot, and take more time than the "
    "rest of "
    "the callback.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("logging", "performance"),
    bad="import rospy\nrospy.Timer(rospy.Duration(0.1), on)\ndef on(event):\n    rospy.loginfo('tick')\n",
    good="import rospy\nrospy.Timer(rospy.Duration(0.1), on)\ndef on(event):\n    rospy.loginfo_throttle(1.0, "
    "'tick')\n",
    syntax="python",
    anchors=("loginfo", "logwarn", "logerr", "logfatal", *sorted(_LEVELS)),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
