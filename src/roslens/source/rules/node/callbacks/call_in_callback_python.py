"""Rule ``node.call_in_callback_python``: a callback in rclpy that calls a service and blocks until it answers."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.flow.python_callbacks import ways_to
from roslens.source.rules.flow.python_reached import where_reached
from roslens.source.rules.flow.python_threads import deadlock_of, made_by
from roslens.source.rules.flow.spoken_way import spoken_way
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_GROUPS = (b"callback_group", b"MultiThreadedExecutor", b"ReentrantCallbackGroup")
_CLIENTS = {"call": frozenset({"create_client"}), "send_goal": frozenset({"ActionClient"})}


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that waits for its answer in a callback, or in what it calls, of a client made in this file."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    if call is None or of is None:
        return
    made = made_by(of, _CLIENTS[view.text(node)], view)
    told = deadlock_of(call, made, view) if made is not None else None
    if told is not None:
        way, blocked = told
        yield view.hit(
            "node.call_in_callback_python",
            call,
            f"`{view.short(call)}` in {spoken_way(way, view)}: the answer needs the executor that waits here, for "
            f"{blocked.because}; expected `await client.call_async(...)`, or a client in a callback group of its own "
            "and a MultiThreadedExecutor",
            certainty=blocked.certainty,
        )
    elif made is not None and not ways_to(call, view):
        yield from _registered_elsewhere(call, view)


def _registered_elsewhere(call: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call in a function that a callback of another file is, or calls."""
    if any(one in view.code for one in _GROUPS):
        return
    where = where_reached(call, view)
    if where:
        yield view.hit(
            "node.call_in_callback_python",
            call,
            f"`{view.short(call)}` in what a callback of another file calls: the answer needs the executor that waits "
            "here; expected `await client.call_async(...)`, or a client in a callback group of its own",
            callback=where,
            certainty=Certainty.LIKELY,
        )


RULE = FileRule(
    id="node.call_in_callback_python",
    title="Blocking call of a service in a callback (rclpy)",
    finds="`client.call(request)`, or `send_goal(goal)` of an action client, in a callback or in a function that one "
    "calls, where the client is in the mutually exclusive callback group of the callback (without a group of their own "
    "both are), or one thread runs all callbacks. Use `call_async` and await it, or give the client a callback group "
    "of its own and spin in several threads.",
    why="The answer is delivered by the executor that waits for this callback to end: both wait for ever, and the "
    "node is dead without a message.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("callbacks", "deadlock"),
    bad="""import rclpy
class Arm(Node):
    def __init__(self):
        self.client = self.create_client(Ask, "ask")
        self.timer = self.create_timer(1.0, self.tick)
    def tick(self):
        answer = self.client.call(Ask.Request())
""",
    good="""import rclpy
class Arm(Node):
    def __init__(self):
        self.client = self.create_client(Ask, "ask")
        self.timer = self.create_timer(1.0, self.tick)
    async def tick(self):
        answer = await self.client.call_async(Ask.Request())
""",
    syntax="python",
    anchors=("call", "send_goal"),
    mentions=RCLPY,
    found=found,
)
