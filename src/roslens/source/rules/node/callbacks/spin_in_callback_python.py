"""Rule ``node.spin_in_callback_python``: a callback in rclpy that spins the executor it runs in."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around
from roslens.source.rules.calls import arguments, call_at, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import python_callbacks, ways_to
from roslens.source.rules.flow.python_reached import where_reached
from roslens.source.rules.flow.python_threads import made_by
from roslens.source.rules.flow.spoken_way import spoken_way
from roslens.source.rules.hit import EITHER, Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_OWN_EXECUTOR = re.compile(rb"\b(?:Single|Multi)ThreadedExecutor\s*\(")
_ANY_NODE = frozenset({"create_node", "Node"})
_LIBRARIES = ("rclpy.", "rospy.")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call of rclpy or rospy that spins in a callback, or in a function that a callback calls."""
    call = call_at(node)
    if call is None or not _is_spin(call, view):
        return
    given = arguments(call)
    if given and _is_other_node(given[0], view):
        # Another node is spun by the global executor while this one runs in its own.
        return
    known = ways_to(call, view)
    if known:
        where = spoken_way(known[0], view)
        callback = ""
    else:
        named = callback_around(call, view)
        if not named:
            return
        callback = EITHER.join((named, where_reached(call, view)))
        where = f"`{named}`, which runs in a callback"
    yield view.hit(
        "node.spin_in_callback_python",
        call,
        f"`{view.short(call)}` in {where}: an executor is running it already; expected `await "
        "client.call_async(...)` or `add_done_callback`",
        callback=callback,
    )


def _is_spin(call: Node, view: FileView) -> bool:
    """Tell whether a call spins the executor that runs the callbacks of the file."""
    callee = view.text(call.child_by_field_name("function"))
    if callee.startswith(_LIBRARIES):
        return True
    if callee.startswith("self.executor."):
        # Of a node it is the executor that runs it, unless the class has one of its own.
        return not re.search(rb"\bself\s*\.\s*executor\s*=", view.code)
    return callee.isidentifier() and re.search(rb"\bfrom rclpy import\b.*\b" + callee.encode(), view.code) is not None


def _is_other_node(node: Node, view: FileView) -> bool:
    """Tell whether a spun node is another than the one whose callback spins."""
    if made_by(node, _ANY_NODE, view) is not None:
        callbacks = python_callbacks(view)
        own = {view.text(receiver(one.call)) for one in callbacks.registrations} if callbacks is not None else set()
        return view.text(node) not in own
    return view.text(node) != "self" and view.has(_OWN_EXECUTOR)


RULE = FileRule(
    id="node.spin_in_callback_python",
    title="Spinning in a callback (Python)",
    finds="`rclpy.spin_until_future_complete`, `spin_once` or `spin` in a callback or in a function that one "
    "calls, and `rospy.spin`. Await the future in an `async` callback instead, or give it one with "
    "`add_done_callback`.",
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
