"""Rule ``node.dangling_capture``: a callback that uses a variable of a function that has returned."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import arguments, body_of, call_at, function_around
from roslens.source.rules.cpp_flow.local_lambda import local_lambda
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_STAYS = re.compile(rb"spin|\bwait|\bsleep|\bget\(\)|\bjoin\b|\bwhile\b|\brun\s*\(|\bexec\s*\(")

_DECLARING = (
    *("parameter_declaration", "optional_parameter_declaration", "declaration", "reference_declarator"),
    *("pointer_declarator", "array_declarator", "for_range_loop", "structured_binding_declarator"),
)
"""What a name that is declared stands in."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a lambda handed over in a function that returns, which holds a local variable of it by reference."""
    call, function = call_at(node) or _kept(node), function_around(node)
    body = body_of(function) if function is not None else None
    if call is None or function is None or body is None or not _outlives(call, function, body, view):
        return
    for one in _lambdas(call, view):
        held = view.text(one.child_by_field_name("captures"))[1:-1]
        names = [part.strip() for part in held.split(",")]
        locals_ = _locals(body, one, view) & _used(one, view)
        by_name = {part[1:].strip() for part in names if part.startswith("&") and "=" not in part} - {""}
        copied = {re.split(r"\s*=", part)[0].strip() for part in names if part and not part.startswith("&")}
        lost = sorted(locals_ & by_name if "&" not in names else locals_ - copied)
        if lost:
            yield view.hit(
                "node.dangling_capture",
                one,
                f"callback captures local variable `{lost[0]}` by reference, which is gone when `{view.text(node)}`'s "
                f"callback runs; expected `[{lost[0]}]`, or a member",
            )


def _kept(node: Node) -> Node | None:
    """Return the assignment of a callback to options of a goal."""
    around = node.parent
    assigned = around.parent if around is not None and around.type == "field_expression" else None
    is_left = assigned is not None and assigned.type == "assignment_expression"
    return assigned if assigned is not None and is_left and assigned.child_by_field_name("left") == around else None


def _lambdas(call: Node, view: FileView) -> Iterator[Node]:
    """Yield the lambdas that a call gets, themselves or by a variable, or an assignment keeps."""
    right = call.child_by_field_name("right")
    for one in [right] if right is not None else arguments(call):
        if one.type == "lambda_expression":
            yield one
        elif one.type == "identifier":
            kept = local_lambda(view.text(one), one, view)
            if kept is not None:
                yield kept


def _outlives(call: Node, function: Node, body: Node, view: FileView) -> bool:
    """Return whether what a call makes lives on when the function around it has returned."""
    # What a local variable keeps ends with the function, and its callbacks with it.
    if function.type != "function_definition" or (call.parent is not None and call.parent.type == "init_declarator"):
        return False
    return function_name(function, view) != "main" and not _STAYS.search(view.code[body.start_byte : body.end_byte])


def _locals(body: Node, until: Node, view: FileView) -> set[str]:
    """Return the local variables, not static and no references, that a function declares before a node."""
    found_: set[str] = set()
    for one in below(body, "declaration", inside=("lambda_expression",)):
        block = one.parent
        if one.end_byte > until.start_byte or block is None or block.end_byte < until.end_byte:
            continue
        if not {"static", "constexpr", "thread_local", "extern"}.isdisjoint(view.text(one).split("=")[0].split()):
            continue
        for child in one.children_by_field_name("declarator"):
            inner = child.child_by_field_name("declarator") if child.type == "init_declarator" else child
            if inner is not None and inner.type == "identifier":
                found_.add(view.text(inner))
    return found_


def _used(one: Node, view: FileView) -> set[str]:
    body = body_of(one)
    if body is None:
        return set()
    own = {view.text(name) for name in below(one, "identifier") if _is_declared(name)}
    return {view.text(name) for name in below(body, "identifier") if not _is_qualified(name)} - own


def _is_qualified(name: Node) -> bool:
    return name.parent is not None and name.parent.type == "qualified_identifier"


def _is_declared(name: Node) -> bool:
    around = name.parent
    return around is not None and (
        around.type in _DECLARING
        or (around.type == "init_declarator" and around.child_by_field_name("declarator") == name)
    )


RULE = FileRule(
    id="node.dangling_capture",
    title="Callback that captures a local variable by reference",
    finds="A lambda that is handed to a subscription, timer, service, request or goal, itself or by a "
    "variable, and holds a local variable of the function by "
    "reference, in a function that returns. Capture it by value, or make it a member.",
    why="The callback runs when the function has returned: it reads and writes memory that belongs to somebody else by "
    "then, and the robot does what stands there.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("concurrency", "memory"),
    clauses=("core-guidelines F.53",),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::start() { int count = 0; timer_ = create_wall_timer(1s, [&] { move(++count); }); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::start() { int count = 0; timer_ = create_wall_timer(1s, [this, count]() mutable { move(++count); }); }
""",
    syntax="cpp",
    anchors=(
        *("create_subscription", "create_wall_timer", "create_timer", "create_service", "subscribe", "createTimer"),
        *("create_generic_subscription", "add_on_set_parameters_callback", "createWallTimer", "advertiseService"),
        *("async_send_request", "result_callback", "feedback_callback", "goal_response_callback"),
    ),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
