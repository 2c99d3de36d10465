"""Rule ``cpp.unset_variable``: a variable without a value."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_GIVEN = re.compile(rb"[=({\[]")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each local number or pointer without an initialiser."""
    if _GIVEN.search(view.code, node.start_byte, node.end_byte):
        return
    around = node.parent
    if around is None or around.type not in ("compound_statement", "case_statement"):
        return
    if any(one.type == "storage_class_specifier" for one in node.children):
        return
    kind = node.child_by_field_name("type")
    is_number = kind is not None and kind.type in ("primitive_type", "sized_type_specifier")
    for one in node.children_by_field_name("declarator"):
        if (is_number and one.type == "identifier") or (
            one.type == "pointer_declarator" and one.named_child_count == 1
        ):
            yield view.hit(
                "cpp.unset_variable", one, f"`{view.text(one)}` has no value; expected one where it is declared"
            )


RULE = FileRule(
    id="cpp.unset_variable",
    title="Local variable without a value",
    finds="A local variable of a number, `bool` or pointer type that is declared without a value. Give it one, "
    "or declare it where it gets one.",
    why="A branch that forgets to set it drives with what was on the stack.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2023 11.6.1",
        "autosar-cpp14 A8-5-0",
        "jsf-av 142",
        "clang-tidy cppcoreguidelines-init-variables",
    ),
    bad="int f() { int a; g(&a); return a; }\n",
    good="int f() { int a = 0; g(&a); return a; }\n",
    syntax="cpp",
    kinds=(
        "(declaration type: [(primitive_type) (sized_type_specifier)] declarator: (identifier)) @node",
        "(declaration declarator: (pointer_declarator)) @node",
    ),
    found=found,
)
