"""Rule ``node.future_in_callback``: a callback in rclcpp that waits for the answer of a service."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, callee_name, spoken
from roslens.source.rules.calls import AT_ONCE, arguments, body_of, call_at, function_around, receiver
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_READY = "future_status::ready"
_REQUESTS = ("async_send_request", "async_send_goal", "async_get_result", "async_cancel_goal")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a wait for a future that the same function got of a request."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    function = function_around(node)
    body = body_of(function) if function is not None else None
    if call is None or of is None or body is None:
        return
    written = view.text(body)
    if not any(one in written for one in _REQUESTS):
        return
    name = re.escape(view.text(of).removesuffix(".future"))
    if not re.search(rf"(?<![\w.]){name}\s*=[^;]*\b({'|'.join(_REQUESTS)})\b", written):
        return
    if _is_spun_for(name, call, body, view) or _asks_whether_it_is_there(name, call, body, view):
        return
    callback = callback_around(call, view)
    if callback is not None:
        groups = b"create_callback_group" in view.code or b"MultiThreadedExecutor" in view.code
        yield view.hit(
            "node.future_in_callback",
            call,
            f"`{view.text(call)}` in {spoken(callback)}: the answer comes by the executor that waits here; expected a "
            "callback as the second argument of the request",
            callback=callback,
            certainty=Certainty.HEURISTIC if groups else None,
        )


def _is_spun_for(name: str, call: Node, body: Node, view: FileView) -> bool:
    """Return whether a call stands behind one that spins until the same future is complete.

    That one throws in a callback, which ``node.spin_in_callback`` says, or the answer is there.
    """
    spun = rf"\bspin_until_future_complete\s*(?:<[^;()]*>\s*)?\([^;]*?(?<![\w.]){name}\b"
    return re.search(spun.encode(), view.code[body.start_byte : call.start_byte]) is not None


def _asks_whether_it_is_there(name: str, call: Node, body: Node, view: FileView) -> bool:
    """Return whether a call does not wait, or stands behind such a call for the same future."""
    around = above(call, "if_statement", "function_definition", "lambda_expression")
    condition = around.child_by_field_name("condition") if around is not None else None
    if condition is not None and condition.end_byte <= call.start_byte and _READY in view.text(condition):
        return True
    if callee_name(call, view) == "wait_for":
        return any(AT_ONCE.search(view.text(one)) for one in arguments(call))
    asked = re.search(
        rf"\b{name}(?:\.future)?\s*\.\s*wait_for\s*\(([^;]*?)\)\s*[!=]=".encode(),
        view.code[body.start_byte : call.start_byte],
    )
    return asked is not None and AT_ONCE.search(asked[1].decode("utf-8", "replace")) is not None


RULE = FileRule(
    id="node.future_in_callback",
    title="Waiting for the answer of a service in a callback",
    finds="A callback that sends a request and waits for its future. Give the request a callback of its own instead. "
    "Where it spins until the future is complete before, `node.spin_in_callback` says so.",
    why="The answer is delivered by the executor that waits for this callback to end. In a single thread, or in the "
    "same "
    "callback group, both wait for ever.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("callbacks", "deadlock"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { auto answer = client_->async_send_request(r_); answer.wait(); }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { client_->async_send_request(r_, [this](Client::SharedFuture answer) { take(answer.get()); }); }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    syntax="cpp",
    anchors=("wait", "get", "wait_for"),
    mentions=("async_send_request", "async_send_goal"),
    found=found,
)
