"""Rule ``node.rate_without_thread``: a rate of rclpy that nobody wakes."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_SPINS_ELSEWHERE = re.compile(rb"[tT]hread|MultiThreadedExecutor|asyncio|ReentrantCallbackGroup|multiprocessing")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``create_rate`` in a file that sleeps by it and spins in no other thread."""
    call = call_at(node)
    if call is None or _SPINS_ELSEWHERE.search(view.code) or not _is_slept_on(call, view):
        return
    yield view.hit(
        "node.rate_without_thread",
        call,
        f"`{view.text(call)}`: `sleep()` of it waits for a timer that only a spinning executor runs, and nothing here "
        "spins meanwhile; expected `rclpy.spin` in a thread, or `create_timer`",
    )


def _is_slept_on(call: Node, view: FileView) -> bool:
    """Return whether ``sleep`` is called on a rate: at once, or on what it is assigned to by its last name."""
    around = call.parent
    if around is not None and around.type == "assignment":
        name = view.text(around.child_by_field_name("left")).rpartition(".")[2].encode()
        return re.search(rb"\b" + re.escape(name) + rb"\s*\.\s*sleep\b", view.code) is not None
    return view.text(around).endswith(".sleep")


RULE = FileRule(
    id="node.rate_without_thread",
    title="Rate without a spinning thread (rclpy)",
    finds="`create_rate` and `sleep()` of that rate in a program that spins in no other thread: `spin_once` before it "
    "does not help. Use a timer, or spin in a thread.",
    why="`Rate.sleep()` of rclpy waits for a timer of the node, and timers run in the executor: slept on in the "
    "thread that "
    "should spin, it never returns.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("lifetime", "deadlock"),
    bad="""import rclpy
rate = node.create_rate(10)
while rclpy.ok():
    rate.sleep()
""",
    good="""import rclpy
timer = node.create_timer(0.1, work)
rclpy.spin(node)
""",
    syntax="python",
    anchors=("create_rate",),
    mentions=RCLPY,
    found=found,
)
