"""Rule ``node.parameter_in_callback_python``: a callback of rospy that asks the master for a parameter."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at, function_around, is_conditional
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROSPY, FileRule

_TIMER = re.compile(r"\b(event|evt|timer_event)\b|^\((self)?\)$")
_ASKED = re.compile(rb"rospy\.\w+_param\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call of the parameter server that each message or tick makes."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or is_conditional(call, function):
        return
    if not view.text(call.child_by_field_name("function")).startswith("rospy."):
        return
    if _TIMER.search(view.text(function.child_by_field_name("parameters"))):
        return
    if _ASKED.search(view.code[function.start_byte : call.start_byte]):
        return
    callback = callback_around(call, view, of_stream=True)
    if callback is not None:
        yield view.hit(
            "node.parameter_in_callback_python",
            call,
            f"`{view.text(call)}` in {spoken(callback)} asks the master each time; expected it read once, in "
            "`__init__`",
            callback=callback,
        )


RULE = FileRule(
    id="node.parameter_in_callback_python",
    title="Parameter server asked in a callback (rospy)",
    finds="`rospy.get_param`, `has_param` or `set_param` in a callback of a subscription, once a callback. Read it "
    "once, or "
    "use "
    "dynamic_reconfigure.",
    why="Each call is an XML-RPC request to the master: some milliseconds a message, and where the master is slow or "
    "gone, "
    "the callback waits.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros1",),
    tags=("parameters", "callbacks", "real-time"),
    bad="import rospy\nrospy.Subscriber('goal', Goal, on)\ndef on(goal):\n    limit = rospy.get_param('~limit')\n",
    good="import rospy\nlimit = rospy.get_param('~limit')\nrospy.Subscriber('goal', Goal, on)\n"
    "def on(goal):\n    use(limit)\n",
    syntax="python",
    anchors=("get_param", "has_param", "set_param", "search_param"),
    mentions=ROSPY,
    found=found,
)
