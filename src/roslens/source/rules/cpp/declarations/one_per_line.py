"""Rule ``cpp.one_per_line``: several variables in one declaration."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each declaration of more than one name."""
    if len(node.children_by_field_name("declarator")) > 1 and (
        node.parent is None or node.parent.type != "for_statement"
    ):
        yield view.hit(
            "cpp.one_per_line",
            node,
            f"`{view.short(node)}` declares several; expected one declaration for each",
        )


RULE = FileRule(
    id="cpp.one_per_line",
    title="Several variables in one declaration",
    finds="`int a, b;` declares several variables. Declare each for itself; heads of loops are let be.",
    why="`char* a, b;` declares one pointer.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "hicpp 7.1.1",
        "misra-cpp-2008 8-0-1",
        "autosar-cpp14 A7-1-7",
        "jsf-av 152",
        "clang-tidy readability-isolate-declaration",
    ),
    bad="int a, b;\n",
    good="int a;\nint b;\n",
    syntax="cpp",
    kinds=tuple(f"({kind} declarator: (_) declarator: (_)) @node" for kind in ("declaration", "field_declaration")),
    found=found,
)
