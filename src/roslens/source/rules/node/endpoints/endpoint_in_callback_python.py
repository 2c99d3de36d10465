"""Rule ``node.endpoint_in_callback_python``: a publisher, subscription or client made again and again, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_conditional, loop_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_RENEWED = re.compile(rb"return|cancel\(\)|unregister\(\)")
"""What stands before a call that is not reached each time, or that makes again what was given up."""
_FOREVER = re.compile(r"is_shutdown|rclpy\.ok|^\(?(True|1)\)?$")
_NEVER_RETURNS = re.compile(rb"\bwhile\s+not\s+rospy\.is_shutdown\(\)\s*:(?!.*\b(?:break|return|raise)\b)", re.DOTALL)
"""Behind what is made once, as the callback runs until shutdown."""
_IF_NEW = re.compile(rb"\bif\b[^\n]*\bin\b[^\n]*:\s*continue\b")
"""Before what is made once for each that is new."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that makes an endpoint each time round, where no condition guards it."""
    call = call_at(node)
    if call is None or not arguments(call):
        return
    callee, name = view.text(call.child_by_field_name("function")), view.text(node)
    if not name.startswith("create_") and callee not in (f"rospy.{name}", name, f"actionlib.{name}"):
        return
    expected = "expected it to be made once, in `__init__`"
    loop, function = loop_around(call), function_around(call)
    if loop is not None and _FOREVER.search(view.text(loop.child_by_field_name("condition"))):
        if not is_conditional(call, loop) and not _is_left(loop, view):
            yield view.hit(
                "node.endpoint_in_callback_python", call, f"`{callee}` in a loop that runs for ever; {expected}"
            )
        return
    callback = callback_around(call, view, of_stream=True)
    body = body_of(function) if function is not None else None
    if function is None or callback is None or body is None or is_conditional(call, function):
        return
    before = view.code[body.start_byte : call.start_byte]
    behind = view.code[call.end_byte : body.end_byte]
    if _is_told(call, node, before, view) or _RENEWED.search(before) or _NEVER_RETURNS.search(behind):
        return
    yield view.hit(
        "node.endpoint_in_callback_python",
        call,
        f"`{callee}` in {spoken(callback)}, each time that it runs; {expected}",
        callback=callback,
    )


def _is_left(loop: Node, view: FileView) -> bool:
    """Return whether a loop ends by itself: it goes through what there is, and leaves when there is no more."""
    return re.search(rb"\b(?:break|return|raise)\b", view.code[loop.start_byte : loop.end_byte]) is not None


def _is_told(call: Node, node: Node, before: bytes, view: FileView) -> bool:
    """Return whether the function is given the topic, or goes through new ones: it is another one each time."""
    if _IF_NEW.search(before):
        return True
    given = arguments(call)
    place = 1 if view.text(node).startswith("create_") else 0
    if len(given) <= place or given[place].type not in ("identifier", "attribute"):
        return False
    return re.search(re.escape(view.text(given[place]).encode()) + rb"\s*=(?!=)", before) is not None


RULE = FileRule(
    id="node.endpoint_in_callback_python",
    title="Endpoint made in a callback or a loop (Python)",
    finds="A publisher, subscription, service or client that is made each time a callback of a subscription or timer "
    "runs, "
    "or in a loop that runs for ever. Make it once. A `rospy.ServiceProxy` connects only when it is called.",
    why="What is published on a publisher that was made just now is lost; subscriptions and clients add up, and each "
    "message is handled once more than before.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("endpoints", "callbacks"),
    bad="""import rospy
rospy.Subscriber("goal", Goal, on_goal)
def on_goal(goal):
    pub = rospy.Publisher("state", State, queue_size=1)
    pub.publish(State())
""",
    good="""import rospy
pub = rospy.Publisher("state", State, queue_size=1)
rospy.Subscriber("goal", Goal, on_goal)
def on_goal(goal):
    pub.publish(State())
""",
    syntax="python",
    anchors=(
        *("create_publisher", "create_subscription", "create_client", "create_service", "Publisher", "Subscriber"),
        "SimpleActionClient",
    ),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
