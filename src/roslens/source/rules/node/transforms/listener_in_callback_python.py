"""Rule ``node.listener_in_callback_python``: a transform listener or broadcaster made in a callback, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at, function_around, is_conditional
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a listener or broadcaster made in a callback, where no condition guards it."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or is_conditional(call, function):
        return
    is_listener = view.text(node).endswith("Listener")
    # All publishers of rospy on a topic are one, which stays.
    callback = callback_around(call, view) if is_listener or view.mentions((b"rclpy",)) else None
    if callback is not None:
        does = "it hears nothing before it is asked" if is_listener else "what it sends at once is lost"
        yield view.hit(
            "node.listener_in_callback_python",
            call,
            f"`{view.text(call)}` in {spoken(callback)} is made anew each time: {does}; expected it in `__init__`",
            callback=callback,
        )


RULE = FileRule(
    id="node.listener_in_callback_python",
    title="Transform listener or broadcaster made in a callback (Python)",
    finds="`TransformListener` made in a callback, or `TransformBroadcaster` in one of rclpy. Make it once, in "
    "`__init__`.",
    why="A new listener subscribes and knows no transform yet, so each look-up fails or waits; a new broadcaster of "
    "rclpy has no subscriber yet, so what it sends is lost. Those of rospy share one publisher, which stays.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms", "callbacks"),
    bad="import rospy\nrospy.Subscriber('odom', Odometry, on)\ndef on(m):\n"
    "    tf.TransformListener().lookupTransform('map', 'base_link', m.header.stamp)\n",
    good="import rospy\nrospy.Subscriber('odom', Odometry, on)\nlistener = tf.TransformListener()\n"
    "def on(m):\n    listener.lookupTransform('map', 'base_link', m.header.stamp)\n",
    syntax="python",
    anchors=("TransformListener", "TransformBroadcaster", "StaticTransformBroadcaster"),
    mentions=ROS_PYTHON,
    found=found,
)
