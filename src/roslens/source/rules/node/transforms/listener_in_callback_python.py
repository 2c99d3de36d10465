"""Rule ``node.listener_in_callback_python``: a transform listener or broadcaster made in a callback, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

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
    callback = callback_around(call, view)
    if callback is not None:
        is_listener = view.text(node).endswith("Listener")
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
    finds="`TransformListener` or `TransformBroadcaster` made in a callback. Make it once, in `__init__`.",
    why="A new listener subscribes and knows no transform yet, so each look-up fails or waits; a new broadcaster has "
    "no "
    "subscriber yet, so what it sends is lost.",
    profiles=("ros2", "ros1"),
    tags=("transforms", "callbacks"),
    bad="import rospy\nrospy.Subscriber('odom', Odometry, on)\ndef on(m):\n    tf.TransformBroadcaster().send(m)\n",
    good="import rospy\nrospy.Subscriber('odom', Odometry, on)\nsender = tf.TransformBroadcaster()\n"
    "def on(m):\n    sender.send(m)\n",
    syntax="python",
    anchors=("TransformListener", "TransformBroadcaster", "StaticTransformBroadcaster"),
    mentions=ROS_PYTHON,
    found=found,
)
