"""Rule ``node.endpoint_in_callback_python``: a publisher, subscription or client made again and again, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_conditional, loop_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_FOREVER = re.compile(r"is_shutdown|rclpy\.ok|^\(?(True|1)\)?$")


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
        if not is_conditional(call, loop):
            yield view.hit(
                "node.endpoint_in_callback_python", call, f"`{callee}` in a loop that runs for ever; {expected}"
            )
        return
    callback = callback_around(call, view, of_stream=True)
    body = body_of(function) if function is not None else None
    if function is None or callback is None or body is None or is_conditional(call, function):
        return
    before = view.code[body.start_byte : call.start_byte]
    if b"return" not in before and b"cancel()" not in before and b"unregister()" not in before:
        yield view.hit(
            "node.endpoint_in_callback_python",
            call,
            f"`{callee}` in {spoken(callback)}, each time that it runs; {expected}",
            callback=callback,
        )


RULE = FileRule(
    id="node.endpoint_in_callback_python",
    title="Endpoint made in a callback or a loop (Python)",
    finds="A publisher, subscription, service or client that is made each time a callback of a subscription or timer "
    "runs, "
    "or in a loop that runs for ever. Make it once. A `rospy.ServiceProxy` connects only when it is called.",
    why="What is published on a publisher that was made just now is lost; subscriptions and clients add up, and each "
    "message is handled once more than before.",
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
