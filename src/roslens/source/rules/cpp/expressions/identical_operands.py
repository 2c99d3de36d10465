"""Rule ``cpp.identical_operands``: an operator with the same thing on both sides."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.cpp_statement import is_written_twice
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_OPERATORS = frozenset({"&&", "||", "<", ">", "<=", ">=", "-", "/", "%", "|", "&", "^", "and", "or"})

_CONSTANT = re.compile(r"[A-Z][A-Z0-9_]+")
_ASKS = re.compile(r"!?(?:[\w.]|->|::)*\b(?:is|has|empty|size|count|contains|abs|fabs)\w*\([^()]*\)")


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each expression whose two sides are written alike."""
    for node in nodes:
        left = node.child_by_field_name("left")
        if left is not None and is_written_twice(left, node, view):
            yield from _found(node, left, view)


def _found(node: Node, left: Node, view: FileView) -> Iterator[Hit]:
    if left.type in ("number_literal", "string_literal", "char_literal"):
        return
    operator = view.text(node.child_by_field_name("operator"))
    text = view.text(left)
    if operator not in _OPERATORS or "++" in text or "--" in text or is_declaration(node) or not text:
        return
    if _is_meant(operator, left.type, text):
        return
    # What is called twice may give two values.
    if "(" in text and not _ASKS.fullmatch(text):
        return
    if node.parent is not None and node.parent.type in ("template_argument_list", "ERROR"):
        return
    if above(node, "preproc_if", "preproc_elif") is not None and _is_condition(node):
        return  # `defined X && X`: whether it is there, and then its value
    if b"," in view.content[left.end_byte : node.end_byte] or _is_asked_for_its_type(node):
        return
    yield view.hit(
        "cpp.identical_operands",
        node,
        f"`{shortened(text, 60)}` on both sides of `{operator}`; expected two different operands",
    )


def _is_meant(operator: str, kind: str, text: str) -> bool:
    """Return whether a name is written twice on purpose.

    So is an offset from the first of several constants, written as the others are, and the usual way to a register of
    zeros.
    """
    if text in ("INFINITY", "NAN"):
        return True
    return (operator == "-" and _CONSTANT.fullmatch(text) is not None) or (operator == "^" and kind == "identifier")


def _is_condition(node: Node) -> bool:
    """Return whether a node is what a condition of the preprocessor asks for."""
    while node.parent is not None and not node.parent.type.startswith("preproc_"):
        node = node.parent
    around = node.parent
    return around is not None and around.child_by_field_name("condition") == node


def _is_asked_for_its_type(node: Node) -> bool:
    """Return whether a member of the result is asked for: ``(a - a).rows()`` is of the type, not of the value."""
    around = node.parent
    if around is None or around.type != "parenthesized_expression" or around.parent is None:
        return False
    return around.parent.type == "field_expression"


def is_declaration(node: Node) -> bool:
    """Return whether a node is a declaration that was read as an expression."""
    return node.parent is not None and node.parent.type == "expression_statement"


RULE = FileRule(
    id="cpp.identical_operands",
    title="The same on both sides of an operator",
    finds="Two operands that are written alike around `&&`, `||`, `<`, `>`, `<=`, `>=`, `-`, `/`, `%`, `|`, `&` "
    "or `^`. One of them was meant to be another.",
    why="`x > min && x > min` checks one limit twice and the other never: a joint is driven past its end.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy misc-redundant-expression",),
    bad="bool f(int x, int a, int b) { return x > a && x > a; }\n",
    good="bool f(int x, int a, int b) { return x > a && x < b; }\n",
    syntax="cpp",
    kinds=("binary_expression",),
    found_among=found_among,
)
