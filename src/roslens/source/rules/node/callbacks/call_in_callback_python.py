"""Rule ``node.call_in_callback_python``: a callback in rclpy that calls a service and blocks until it answers."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_GROUPS = (b"callback_group", b"MultiThreadedExecutor", b"ReentrantCallbackGroup")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``client.call`` in a callback, of a client made in this file without a group of its own."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    if call is None or of is None or any(one in view.code for one in _GROUPS):
        return
    name = re.escape(view.text(of).encode())
    if not re.search(
        rb"(?<![\w.])" + name + rb"\s*(:[^=\n]*)?=\s*(?:self\.|(?:self\.)?_?node\.)create_client\b", view.code
    ):
        return
    callback = callback_around(call, view)
    if callback is not None:
        yield view.hit(
            "node.call_in_callback_python",
            call,
            f"`{view.text(call)}` in {spoken(callback)}: the answer needs the executor that waits here; expected "
            "`await client.call_async(...)`, or a client in a callback group of its own",
            callback=callback,
        )


RULE = FileRule(
    id="node.call_in_callback_python",
    title="Blocking call of a service in a callback (rclpy)",
    finds="`client.call(request)` in a callback of a node with one callback group. Use `call_async` and await it, or "
    "give "
    "the client a callback group of its own and spin in several threads.",
    why="The answer is delivered by the executor that waits for this callback to end: both wait for ever, and the "
    "node is "
    "dead without a message.",
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
    anchors=("call",),
    mentions=RCLPY,
    found=found,
)
