"""Rule ``node.dangling_buffer``: an asynchronous transfer from or into a variable of a function that has returned."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import arguments, body_of, call_at, function_around
from roslens.source.rules.cpp_flow.variable_type import local_declaration
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_STAYS = re.compile(
    rb"\bco_await\b|\byield\b|use_awaitable|use_future|\bpoll(?:_one)?\s*\(|\brun(?:_one|_for|_until)?\s*\(|\bwait|\bsleep"
    rb"|\bget\s*\(\s*\)|\bjoin\b|\bawait_"
)
"""What keeps a function from returning before the transfer has ended."""
_KEPT = re.compile(
    r"[&*]|\b(?:static|thread_local|extern|shared_ptr|unique_ptr|span|string_view|\w*buffers?_?\d?)\b|auto"
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the buffer of each transfer that is made of a local variable by name."""
    call = call_at(node)
    function = function_around(node)
    body = body_of(function) if function is not None else None
    if call is None or function is None or body is None or function.type != "function_definition":
        return
    if function_name(function, view) == "main" or _STAYS.search(view.code[body.start_byte : body.end_byte]):
        return
    for one in below(call, "call_expression"):
        if not re.fullmatch(r"(?:\w+::)*buffer", view.text(one.child_by_field_name("function"))):
            continue
        held = next(iter(arguments(one)), None)
        if held is None or held.type != "identifier" or not _is_local(held, body, view):
            continue
        yield view.hit(
            "node.dangling_buffer",
            one,
            f"`{view.text(node)}` goes on when this function has returned, and `{view.text(held)}` is gone then; "
            "expected a member, or a shared pointer that the handler keeps",
        )


def _is_local(name: Node, body: Node, view: FileView) -> bool:
    """Return whether a name is a variable of a function that ends with it and holds what is transferred itself."""
    declared = local_declaration(view.text(name), name, view)
    if declared is None or declared.type != "declaration" or not body.start_byte <= declared.start_byte:
        return False
    return not _KEPT.search(view.text(declared).partition("=")[0].partition(view.text(name))[0])


RULE = FileRule(
    id="node.dangling_buffer",
    title="Asynchronous transfer of a local variable",
    finds="`async_write`, `async_send` or `async_read` of Boost.Asio with a buffer of a local variable, in a function "
    "that returns before the transfer ends. Keep the data in a member, or in a shared pointer that the handler holds.",
    why="What is sent to the motor is whatever stands at that place of the stack by then: commands are damaged now and "
    "then, and nobody can tell when.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="void Port::send(const Command& command) {\n  std::vector<uint8_t> packet = encode(command);\n"
    "  boost::asio::async_write(port_, boost::asio::buffer(packet), [this](auto error, auto) { done(error); });\n}\n",
    good="void Port::send(const Command& command) {\n  packet_ = encode(command);\n"
    "  boost::asio::async_write(port_, boost::asio::buffer(packet_), [this](auto error, auto) { done(error); });\n}\n",
    syntax="cpp",
    anchors=(
        *("async_write", "async_write_some", "async_read", "async_read_some", "async_send", "async_send_to"),
        *("async_receive", "async_receive_from"),
    ),
    found=found,
)
