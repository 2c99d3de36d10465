"""Rule ``node.future_in_callback``: a callback in rclcpp that waits for the answer of a service."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name, spoken
from roslens.source.rules.calls import AT_ONCE, arguments, body_of, call_at, function_around, receiver
from roslens.source.rules.cpp_flow.callback_chain import Chain, chain_to
from roslens.source.rules.cpp_flow.callback_groups import (
    group_of_callback,
    group_of_client,
    groups_of,
    is_plain_node,
    one_thread,
)
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_THREADS = re.compile(rb"MultiThreadedExecutor")
_READY = "future_status::ready"
_REQUESTS = ("async_send_request", "async_send_goal", "async_get_result", "async_cancel_goal")
_REQUEST = re.compile(rf"(\w+)\s*(?:->|\.)\s*(?:{'|'.join(_REQUESTS)})\b")
_OTHER_NODE = re.compile(r"\b(?!this\b|node_?\b|shared_from_this\b)(\w*[nN]ode\w*)\s*(?:->|,)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a wait for a future that the same function got of a request."""
    call = call_at(node)
    of = receiver(call) if call is not None else None
    function = function_around(node)
    body = body_of(function) if function is not None else None
    if call is None or of is None or body is None:
        return
    name = re.escape(view.text(of).removesuffix(".future"))
    client = _asked(of, name, body, view)
    if not client or _is_spun_for(name, call, body, view) or _asks_whether_it_is_there(name, call, body, view):
        return
    chain = chain_to(call, view)
    certainty = _certainty(chain, client, view) if chain is not None else None
    if chain is None or certainty is None:
        return
    yield view.hit(
        "node.future_in_callback",
        call,
        f"`{view.short(call)}` in {spoken(chain.callback)}{chain.through}: the answer comes by the executor that waits "
        "here; expected a callback as the second argument of the request",
        callback=chain.callback,
        certainty=None if certainty is Certainty.LIKELY else certainty,
    )


def _asked(of: Node, name: str, body: Node, view: FileView) -> str:
    """Return the client to which the request went that a future stands for; empty where it stands for none."""
    written = view.text(body)
    if not any(one in written for one in _REQUESTS):
        return ""
    direct = _REQUEST.search(view.text(of))
    if direct is not None:
        return direct[1]
    assigned = re.search(rf"(?<![\w.]){name}\s*(?:=|\(|\{{)([^;]*\b(?:{'|'.join(_REQUESTS)})\b)", written)
    client = _REQUEST.search(assigned[1]) if assigned is not None else None
    return client[1] if client is not None else ("?" if assigned is not None else "")


def _certainty(chain: Chain, client: str, view: FileView) -> Certainty | None:
    """Return how certain it is that nobody takes the answer; None where another thread may, for all that is seen."""
    groups = groups_of(view)
    if _is_of_other_node(client, view) or not is_plain_node(view):
        return Certainty.HEURISTIC
    if not (groups.reentrant or groups.exclusive):
        # However many threads there are: client and callback are both in the default group of the node.
        made_elsewhere = b"callback_group" in view.code or group_of_client(client, view) is None
        return Certainty.HEURISTIC if made_elsewhere and view.has(_THREADS) else Certainty.LIKELY
    if one_thread(view):
        return Certainty.LIKELY
    of_client, of_callback = group_of_client(client, view), group_of_callback(chain.callback, view)
    if of_client is None or of_callback is None or not chain.callback:
        return Certainty.HEURISTIC
    if of_client != of_callback or of_client in groups.reentrant:
        return None
    return Certainty.LIKELY


def _is_of_other_node(client: str, view: FileView) -> bool:
    """Return whether a client is made by a node that is not the one whose callbacks the file registers."""
    made = rf"\b{re.escape(client)}\s*=([^;=]*)\bcreate_client\b"
    found_ = re.search(made.encode(), view.code)
    return found_ is not None and _OTHER_NODE.search(found_[1].decode("utf-8", "replace")) is not None


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
        if _is_repeated(call):
            return False
        return any(AT_ONCE.search(view.text(one)) for one in arguments(call))
    asked = re.search(
        rf"\b{name}(?:\.future)?\s*\.\s*wait_for\s*\(([^;]*?)\)\s*[!=]=".encode(),
        view.code[body.start_byte : call.start_byte],
    )
    return asked is not None and AT_ONCE.search(asked[1].decode("utf-8", "replace")) is not None


def _is_repeated(call: Node) -> bool:
    """Return whether a call stands in the condition of a loop, which asks until the answer is there."""
    loop = above(call, "while_statement", "do_statement", "compound_statement")
    return loop is not None and loop.type != "compound_statement"


RULE = FileRule(
    id="node.future_in_callback",
    title="Waiting for the answer of a service in a callback",
    finds="A callback that sends a request and waits for its future, itself or in a function of the file it calls, "
    "or asks in a loop until it is ready. A client in another callback group than the callback is right where several "
    "threads spin. Give the request a callback of its own instead. "
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
