"""Rule ``node.publish_too_early_python``: a message that is published before anybody can be connected, in Python."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.calls import body_of, call_at, function_around, is_conditional, loop_around, statement_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_TIME_PASSES = re.compile(
    rb"sleep|spin|wait|input|get_num_connections|get_subscription_count|TRANSIENT|transient|[lL]atch|lookup|for |"
    rb"while |qos",
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first ``publish`` in the function that made the publisher, where nothing waits between."""
    call = call_at(node)
    if call is None or call.parent is None or call.parent.type != "assignment":
        return
    function = function_around(call)
    body = body_of(function) if function is not None else view.root
    name = view.text(call.parent.child_by_field_name("left"))
    if body is None or not name or "[" in name or (function is not None and is_conditional(call, function)):
        return
    start = statement_around(call).end_byte
    match = re.search(rb"(?<![\w.])" + re.escape(name.encode()) + rb"\.(publish)\b", view.code[start : body.end_byte])
    if match is None or _TIME_PASSES.search(view.code[call.start_byte : start + match.end()]):
        return
    place = view.node_at(start + match.start(1), start + match.end(1))
    if place is not None and function_around(place) == function and loop_around(place) == loop_around(call):
        yield view.hit(
            "node.publish_too_early_python",
            place.parent or place,
            f"`{name}` publishes right after it was made, before any subscription is matched: the message is lost; "
            "expected it later, or transient local (latched)",
        )


RULE = FileRule(
    id="node.publish_too_early_python",
    title="Message published right after its publisher was made (Python)",
    finds="A publisher and its first `publish` in one function, with no wait between. Publish later, wait for "
    "subscriptions, or make it transient local (rclpy) or latched (rospy).",
    why="Subscriptions are matched over the network after the call that makes the publisher: what is published at once "
    "reaches nobody, on most days.",
    profiles=("ros2", "ros1"),
    tags=("endpoints",),
    bad="""import rospy
pub = rospy.Publisher("state", State, queue_size=1)
pub.publish(State())
""",
    good="""import rospy
pub = rospy.Publisher("state", State, queue_size=1, latch=True)
pub.publish(State())
""",
    syntax="python",
    anchors=("Publisher", "create_publisher"),
    mentions=ROS_PYTHON,
    spares_tests=True,
    found=found,
)
