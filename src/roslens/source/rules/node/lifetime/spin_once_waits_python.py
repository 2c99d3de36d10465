"""Rule ``node.spin_once_waits_python``: a loop that publishes and waits in ``spin_once`` for something to come."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords, loop_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_WAKES = (b"create_timer", b"create_rate", b"Timer(")
"""What gives the executor something to do by itself."""
_PUBLISHES = re.compile(rb"\.\s*publish\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``spin_once`` without a time limit in a loop that publishes, in a file without timers."""
    call = call_at(node)
    loop = loop_around(call) if call is not None else None
    if call is None or loop is None or loop.type != "while_statement" or any(one in view.code for one in _WAKES):
        return
    of_module = view.text(call.child_by_field_name("function")) == "rclpy.spin_once"
    if len(arguments(call)) != int(of_module) or {"timeout_sec", "**"} & keywords(call, view).keys():
        return
    if _PUBLISHES.search(view.code, loop.start_byte, loop.end_byte):
        yield view.hit(
            "node.spin_once_waits_python",
            call,
            f"`{view.text(call)}` has no time limit: the loop, which publishes, stands still until something comes for "
            "the node; expected `timeout_sec=`, or a timer that publishes",
        )


RULE = FileRule(
    id="node.spin_once_waits_python",
    title="Loop that waits for a message before it goes on (rclpy)",
    finds="`spin_once` without `timeout_sec` in a `while` loop that publishes, in a file without timers. Give it a "
    "time limit, or publish in a timer and call `spin`.",
    why="Without a limit `spin_once` waits until there is a message or a request: commands are sent as often as the "
    "node hears something, and none where nothing comes.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("lifetime",),
    bad="import rclpy\nwhile rclpy.ok():\n    node.command.publish(forward)\n    rclpy.spin_once(node)\n",
    good="import rclpy\nwhile rclpy.ok():\n    node.command.publish(forward)\n"
    "    rclpy.spin_once(node, timeout_sec=0.1)\n",
    syntax="python",
    anchors=("spin_once",),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
