"""Rule ``node.goal_unfinished``: the execution of an action that leaves the goal without a result."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import body_of
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_FINISHES = re.compile(rb"(?:->|\.)\s*(?:succeed|abort|canceled)\s*\(")
_WORKS = re.compile(rb"(?:->|\.)\s*(?:publish_feedback|get_goal|is_canceling|is_active|is_executing|execute)\s*\(")
_NAMED = re.compile(rb"\b\w*GoalHandle\w*\b")
_ENDS = re.compile(r"\bok\s*\(|is_active|nullptr|^\(!\s*\w+\)$")
_FUNCTIONS = ("function_definition", "lambda_expression")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function that works on a goal and never finishes it, or a return from it before it is finished."""
    seen: set[int] = set()
    for match in _NAMED.finditer(view.code):
        node = view.node_at(match.start(), match.end())
        parameter = above(node, "parameter_declaration", "compound_statement") if node is not None else None
        if node is not None and parameter is not None and parameter.id not in seen:
            seen.add(parameter.id)
            yield from _found(node, view)


def _found(node: Node, view: FileView) -> Iterator[Hit]:
    if node.type not in ("type_identifier", "identifier"):
        return
    parameter = above(node, "parameter_declaration", "compound_statement", "field_declaration_list")
    function = above(node, "compound_statement", "field_declaration_list", *_FUNCTIONS)
    body = body_of(function) if function is not None and function.type in _FUNCTIONS else None
    if parameter is None or parameter.type != "parameter_declaration" or function is None or body is None:
        return
    name = view.text(name_node(parameter.child_by_field_name("declarator"))).lstrip("&* ")
    code = view.code[body.start_byte : body.end_byte]
    returned = view.text(function.child_by_field_name("type"))
    if not name.isidentifier() or "Response" in view.text(function).partition("{")[0] or returned not in ("void", ""):
        return
    if not re.search(rf"\b{name}\b".encode() + _WORKS.pattern, code) or _is_passed_on(name, body, view):
        return
    first = _FINISHES.search(code)
    if first is None:
        yield view.hit(
            "node.goal_unfinished",
            parameter,
            f"no path of this function finishes the goal: `{name}->succeed()`, `abort()` or `canceled()` is called "
            "nowhere, so that the client waits for its result for ever; expected one of them on each path",
        )
        return
    for one in below(body, "return_statement", inside=("lambda_expression",)):
        if one.start_byte < body.start_byte + first.start() and not _is_shutdown(one, body, view):
            yield view.hit(
                "node.goal_unfinished",
                one,
                f"return without a result of the goal: `{name}->abort(…)` or `canceled(…)` was not called before, so "
                "that the client waits for ever; expected one of them",
            )


def _is_passed_on(name: str, body: Node, view: FileView) -> bool:
    """Return whether somebody else gets the handle, and may finish it."""
    for at in word_places(name.encode(), view, body.start_byte, body.end_byte):
        word = view.node_at(at, at + len(name))
        around = word.parent if word is not None else None
        if word is None or around is None or word.type != "identifier":
            continue
        is_method = around.type == "field_expression" and around.child_by_field_name("argument") == word
        if not is_method and around.type not in ("lambda_capture_specifier", "unary_expression"):
            return True
    return False


def _is_shutdown(statement: Node, body: Node, view: FileView) -> bool:
    """Return whether a return is one of a node that ends, or of a handle that is none or is finished already."""
    around = statement.parent
    while around is not None and around != body:
        condition = around.child_by_field_name("condition")
        if condition is not None and _ENDS.search(view.text(condition)):
            return True
        around = around.parent
    return False


RULE = FileRule(
    id="node.goal_unfinished",
    title="Goal of an action that is never finished",
    finds="A function that works on a goal handle of an rclcpp action server and calls neither `succeed`, `abort` nor "
    "`canceled`, or returns before any of them. Where it hands the handle on, nothing is said.",
    why="The client gets no result: it waits for ever, and the server holds the goal as executing.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("callbacks", "actions"),
    bad="""#include <rclcpp_action/rclcpp_action.hpp>
void Arm::execute(const std::shared_ptr<GoalHandleMove> goal_handle) {
  goal_handle->publish_feedback(feedback_);
}
""",
    good="""#include <rclcpp_action/rclcpp_action.hpp>
void Arm::execute(const std::shared_ptr<GoalHandleMove> goal_handle) {
  goal_handle->publish_feedback(feedback_);
  goal_handle->succeed(result_);
}
""",
    syntax="cpp",
    whole=True,
    words=("publish_feedback", "get_goal", "is_canceling"),
    mentions=("rclcpp_action",),
    spares_tests=True,
    found=found,
)
