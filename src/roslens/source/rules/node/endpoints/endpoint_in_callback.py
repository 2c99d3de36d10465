"""Rule ``node.endpoint_in_callback``: a publisher, subscription or client that is made again and again."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import (
    arguments,
    body_of,
    call_at,
    function_around,
    is_conditional,
    is_static,
    loop_around,
)
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_FOREVER = re.compile(r"\bok\s*\(|^\(?(true|1)\)?$|isShuttingDown")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that makes an endpoint each time round, where no condition guards it."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or not arguments(call) or is_static(call, view):
        return
    expected = "expected it to be made once, in the constructor"
    loop = loop_around(call)
    if loop is not None and _FOREVER.search(view.text(loop.child_by_field_name("condition"))):
        if not is_conditional(call, loop):
            yield view.hit(
                "node.endpoint_in_callback", call, f"`{view.text(node)}` in a loop that runs for ever; {expected}"
            )
        return
    callback = callback_around(call, view, of_stream=True)
    body = body_of(function)
    if callback is not None and body is not None and not is_conditional(call, function) and not _left(call, body, view):
        yield view.hit(
            "node.endpoint_in_callback",
            call,
            f"`{view.text(node)}` in {spoken(callback)}, each time that it runs; {expected}",
            callback=callback,
            certainty=Certainty.HEURISTIC if _is_renewed(call, view) else None,
        )


def _is_renewed(call: Node, view: FileView) -> bool:
    """Tell whether a member keeps the endpoint, and lets the one before go: what is asked for may change."""
    around = call.parent
    kept = around.child_by_field_name("left") if around is not None and around.type == "assignment_expression" else None
    return kept is not None and re.search(r"(?:^this->\w+|_)$", view.text(kept)) is not None


def _left(call: Node, body: Node, view: FileView) -> bool:
    """Tell whether the callback may return before, or runs once."""
    before = view.code[body.start_byte : call.start_byte]
    return b"return" in before or b"cancel()" in before or b".stop()" in before or b"shutdown()" in before


RULE = FileRule(
    id="node.endpoint_in_callback",
    title="Endpoint made in a callback or a loop",
    finds="A publisher, subscription, service or client that is made each time a callback of a subscription or timer "
    "runs, "
    "or in a loop that runs for ever. Make it once.",
    why="Discovery and connecting take longer than a message: what is published on a publisher that was made just now "
    "is "
    "lost, and making them again and again loads every node of the robot.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("endpoints", "callbacks"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { auto pub = create_publisher<State>("state", 10); pub->publish(state_); }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { pub_->publish(state_); }
void Arm::start() {
  pub_ = create_publisher<State>("state", 10);
  timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this));
}
""",
    syntax="cpp",
    anchors=(
        *("create_publisher", "create_subscription", "create_client", "create_service", "advertise", "subscribe"),
        *("serviceClient", "advertiseService"),
    ),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
