"""Rule ``node.spin_in_callback_python``: a callback in rclpy that spins the executor it runs in."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_OWN_EXECUTOR = re.compile(rb"\b(?:Single|Multi)ThreadedExecutor\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call of rclpy or rospy that spins in a callback."""
    call = call_at(node)
    if call is None or not view.text(call.child_by_field_name("function")).startswith(("rclpy.", "rospy.")):
        return
    given = arguments(call)
    if given and view.text(given[0]) != "self" and view.has(_OWN_EXECUTOR):
        # Another node is spun by the global executor while this one runs in its own.
        return
    callback = callback_around(call, view)
    if callback is not None:
        yield view.hit(
            "node.spin_in_callback_python",
            call,
            f"`{view.text(call)}` in {spoken(callback)}, which an executor is running already; expected `await "
            "client.call_async(...)` or `add_done_callback`",
            callback=callback,
        )


RULE = FileRule(
    id="node.spin_in_callback_python",
    title="Spinning in a callback (Python)",
    finds="`rclpy.spin_until_future_complete`, `spin_once` or `spin` in a callback, and `rospy.spin`. Await the future "
    "in an `async` callback instead, or give it one with `add_done_callback`.",
    why="The callback runs in an executor that waits for it: spinning again takes the node out of that executor, and "
    "afterwards it gets no more messages, or both wait for each other.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "deadlock"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.timer = self.create_timer(1.0, self.tick)
    def tick(self):
        future = self.client.call_async(self.request)
        rclpy.spin_until_future_complete(self, future)
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.timer = self.create_timer(1.0, self.tick)
    async def tick(self):
        answer = await self.client.call_async(self.request)
""",
    syntax="python",
    anchors=("spin_until_future_complete", "spin_once", "spin"),
    mentions=ROS_PYTHON,
    found=found,
)
