"""Rule ``cpp.switch_on_bool``: a choice between true and false."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import plain
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each switch on what is true or false."""
    condition = node.child_by_field_name("condition")
    value = plain(condition.child_by_field_name("value")) if condition is not None else None
    if value is None or value.type not in ("binary_expression", "unary_expression", "true", "false"):
        return
    operator = view.text(value.child_by_field_name("operator"))
    if value.type in ("true", "false") or operator in ("==", "!=", "<", ">", "<=", ">=", "&&", "||", "!"):
        yield view.hit("cpp.switch_on_bool", value, f"`switch` on `{view.short(value)}`; expected an `if`")


RULE = FileRule(
    id="cpp.switch_on_bool",
    title="`switch` on a condition",
    finds="A `switch` on a comparison or a negation. Write an `if`.",
    why="A `case 2` of it is never taken.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 6-4-7",
        "autosar-cpp14 M6-4-7",
        "jsf-av 195",
        "paper2016 harosBooleanCase",
        "clang-tidy clang-diagnostic-switch-bool",
    ),
    bad="void f(int a) { switch (a == 3) { case true: g(); } }\n",
    good="void f(int a) { if (a == 3) g(); }\n",
    syntax="cpp",
    kinds=("switch_statement",),
    found=found,
)
