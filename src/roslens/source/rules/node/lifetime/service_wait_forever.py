"""Rule ``node.service_wait_forever``: a loop that waits for a service beyond shutdown."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import body_of, call_at, loop_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_LEAVES = re.compile(r"\bok\s*\(|\b(return|break|throw|exit)\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a wait in the condition of a loop that nothing else ends."""
    call = call_at(node)
    loop = loop_around(call) if call is not None else None
    if call is None or loop is None or loop.type != "while_statement":
        return
    condition, body = loop.child_by_field_name("condition"), body_of(loop)
    if condition is None or not (condition.start_byte <= call.start_byte < condition.end_byte):
        return
    if not _LEAVES.search(view.text(condition)) and not _LEAVES.search(view.text(body)):
        yield view.hit(
            "node.service_wait_forever",
            call,
            f"`while {view.text(condition)}` does not end at shutdown: the wait then returns false at once, again and "
            "again; expected a look at `rclcpp::ok()` in the loop",
        )


RULE = FileRule(
    id="node.service_wait_forever",
    title="Wait for a service that shutdown does not end",
    finds="`while (!client->wait_for_service(...))` without a look at `rclcpp::ok()`. Leave the loop when it is false.",
    why="After Ctrl-C the wait returns false at once: the loop takes a whole processor and floods the log, and the "
    "process "
    "does not end.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("lifetime",),
    bad="#include <rclcpp/rclcpp.hpp>\nvoid Arm::ask() { while (!client_->wait_for_service(1s)) { log(); } }\n",
    good="#include <rclcpp/rclcpp.hpp>\n"
    "void Arm::ask() { while (!client_->wait_for_service(1s)) { if (!rclcpp::ok()) return; } }\n",
    syntax="cpp",
    anchors=("wait_for_service", "wait_for_action_server"),
    mentions=RCLCPP,
    found=found,
)
