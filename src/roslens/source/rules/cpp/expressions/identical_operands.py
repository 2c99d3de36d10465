"""Rule ``cpp.identical_operands``: an operator with the same thing on both sides."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.source.rules.cpp_statement import is_written_twice
from roslens.source.rules.file_view import FileView
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
    if text in ("INFINITY", "NAN") or (operator == "-" and _CONSTANT.fullmatch(text)):
        return  # an offset from the first of several constants, written as the others are
    if operator not in _OPERATORS or "++" in text or "--" in text or is_declaration(node) or not text:
        return
    # What is called twice may give two values.
    if "(" in text and not _ASKS.fullmatch(text):
        return
    if node.parent is not None and node.parent.type in ("template_argument_list", "ERROR"):
        return
    yield view.hit(
        "cpp.identical_operands", node, f"`{text[:60]}` on both sides of `{operator}`; expected two different operands"
    )


def is_declaration(node: Node) -> bool:
    """Return whether a node is a declaration that was read as an expression."""
    return node.parent is not None and node.parent.type == "expression_statement"


RULE = FileRule(
    id="cpp.identical_operands",
    title="The same on both sides of an operator",
    finds="Two operands that are written alike around `&&`, `||`, `<`, `>`, `<=`, `>=`, `-`, `/`, `%`, `|`, `&` "
    "or `^`. One of them was meant to be another.",
    why="`x > min && x > min` checks one limit twice and the other never: a joint is driven past its end.",
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
