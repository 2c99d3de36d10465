"""Rule ``node.wait_in_callback``: a callback that waits for somebody else."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import AT_ONCE, arguments, call_at
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that waits in a callback, unless its time limit is nothing."""
    call = call_at(node)
    if call is None or any(AT_ONCE.search(view.text(one)) for one in arguments(call)):
        return
    callback = callback_around(call, view)
    if callback is not None and not _is_of_once(call, view):
        yield view.hit(
            "node.wait_in_callback",
            call,
            f"`{view.text(call)}` in {spoken(callback)}: its executor thread runs nothing else until it is there; "
            "expected a "
            "look at what is ready (`service_is_ready`, `isServerConnected`) or the wait outside of callbacks",
            callback=callback,
        )


def _is_of_once(call: Node, view: FileView) -> bool:
    """Return whether it stands in a lambda that cancels its timer first: a step of the start, put off."""
    around = above(call, "lambda_expression", "function_definition")
    if around is None or around.type != "lambda_expression":
        return False
    return (
        b"imer" in view.code[around.start_byte : call.start_byte]
        and re.search(
            rb"imer\w*\s*(?:->|\.)\s*(?:cancel|reset|stop)\s*\(", view.code[around.start_byte : call.start_byte]
        )
        is not None
    )


RULE = FileRule(
    id="node.wait_in_callback",
    title="Waiting for a service or an action in a callback",
    finds="`wait_for_service`, `waitForExistence`, `wait_for_action_server`, `waitForServer`, `waitForResult`, "
    "`waitForMessage` in a callback. Look whether it is ready and come back instead.",
    why="Where the other node is late or gone, this one stops reacting to anything, its safety stop included. What is "
    "waited for may need a callback of this very executor: then it waits for ever.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "deadlock"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { if (client_->wait_for_service(5s)) { ask(); } }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { if (client_->service_is_ready()) { ask(); } }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    syntax="cpp",
    anchors=(
        *("wait_for_service", "waitForExistence", "waitForService", "wait_for_action_server", "waitForServer"),
        *("waitForResult", "waitForMessage", "wait_for_message", "waitForActionServerToStart"),
    ),
    mentions=ROS_CPP,
    found=found,
)
