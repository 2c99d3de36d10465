"""Rule ``cpp.use_after_move``: a pointer is followed that was given away."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, loop_around, statement_around
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_flow.leaving import leaves_behind
from roslens.source.rules.cpp_flow.variable_type import local_declaration
from roslens.source.rules.file_view import FileView, all_above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_OWNER = re.compile(r"\b(?:unique_ptr|UniquePtr|shared_ptr|SharedPtr)\b|\bmake_(?:unique|shared)\b")
_BRANCHES = ("conditional_expression", "lambda_expression", "if_statement", "switch_statement", "case_statement")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield where an owning pointer is followed after ``std::move`` of it, in the same block or the next turn."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) != 1 or given[0].type != "identifier" or call.parent is None:
        return
    name, statement = view.text(given[0]), statement_around(call)
    declaration = local_declaration(name, call, view)
    if declaration is None or not _OWNER.search(view.text(declaration)) or _is_doubtful(call, statement, view):
        return
    use = _first_use(name, statement, view)
    again = ""
    if use is None:
        use, again = _in_next_turn(name, call, declaration, view), " in the next turn of the loop"
    if use is not None:
        yield view.hit(
            "cpp.use_after_move",
            use,
            f"`{view.short(use)}`{again} after `{view.short(call)}` in line {call.start_point[0] + 1}: `{name}` is "
            "null then; expected its use before, or a new object",
        )


def _is_doubtful(call: Node, statement: Node, view: FileView) -> bool:
    """Return whether a move may not take place, or its result comes back into the variable."""
    if statement.type not in ("expression_statement", "declaration"):
        return True
    for one in all_above(call):
        if one == statement:
            break
        if one.type in _BRANCHES or (one.type == "binary_expression" and one.children[1].type in ("&&", "||")):
            return True
    name = re.escape(view.text(call.child_by_field_name("arguments"))[1:-1])
    return re.match(rf"{name}\s*=", view.text(statement)) is not None


def _first_use(name: str, statement: Node, view: FileView) -> Node | None:
    """Return the first use of a variable behind a statement in its block, where it follows the pointer."""
    block = statement.parent
    if block is None or block.type != "compound_statement":
        return None
    for at in word_places(name.encode(), view, statement.end_byte, block.end_byte):
        word = view.node_at(at, at + len(name))
        if word is None or word.type != "identifier":
            continue
        return _followed(word, view)
    return None


def _followed(word: Node, view: FileView) -> Node | None:
    """Return the expression in which a name is followed as a pointer; None for any other use."""
    around = word.parent
    if around is None:
        return None
    if around.type == "field_expression" and around.child_by_field_name("argument") == word:
        sign = around.child_by_field_name("operator")
        return around if sign is not None and view.text(sign) == "->" else None
    is_followed = around.type == "pointer_expression" and view.text(around).startswith("*")
    return around if is_followed else None


def _in_next_turn(name: str, call: Node, declaration: Node, view: FileView) -> Node | None:
    """Return where a loop follows a pointer, that it gave away before, in its next turn."""
    loop = loop_around(call)
    body = loop.child_by_field_name("body") if loop is not None else None
    if loop is None or body is None or declaration.end_byte > loop.start_byte or leaves_behind(call, loop):
        return None
    if any(around.type in _BRANCHES for around in takewhile(lambda one: one != loop, all_above(call))):
        return None
    code = view.code[loop.start_byte : loop.end_byte]
    if re.search(rf"(?<![\w.>]){name}\s*(?:=(?!=)|\.\s*(?:reset|swap)\b)".encode(), code):
        return None
    for at in word_places(name.encode(), view, body.start_byte, call.start_byte):
        word = view.node_at(at, at + len(name))
        followed = _followed(word, view) if word is not None and word.type == "identifier" else None
        if followed is not None and local_declaration(name, followed, view) == declaration:
            return followed
    return None


RULE = FileRule(
    id="cpp.use_after_move",
    title="Pointer followed after it was moved away",
    finds="`p->…` or `*p` of a local `unique_ptr` or `shared_ptr` behind `std::move(p)`, such as a message that was "
    "published, in the same block; or in the next turn of a loop in front of which `p` was made.",
    why="What was moved is null: the node crashes, and with a message that was published it works until the first one.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("memory", "messages"),
    clauses=("clang-tidy bugprone-use-after-move", "cppcheck accessMoved"),
    bad="void f() { auto p = std::make_unique<Message>(); out->publish(std::move(p)); log(p->data); }\n",
    good="void f() { auto p = std::make_unique<Message>(); log(p->data); out->publish(std::move(p)); }\n",
    syntax="cpp",
    anchors=("std::move",),
    found=found,
)
