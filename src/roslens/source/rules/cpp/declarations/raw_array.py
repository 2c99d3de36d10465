"""Rule ``cpp.raw_array``: an array that does not know its size."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each array that is declared as a variable or member."""
    around = node.parent
    while around is not None and around.type in ("init_declarator", "array_declarator", "pointer_declarator"):
        around = around.parent
    if (
        around is None
        or around.type not in ("declaration", "field_declaration")
        or (node.parent is not None and node.parent.type == "array_declarator")
    ):
        return
    if view.text(around.child_by_field_name("type")) not in ("char", "wchar_t"):
        yield view.hit("cpp.raw_array", node, f"`{view.short(node)}` does not know its size; expected std::array")


RULE = FileRule(
    id="cpp.raw_array",
    title="Array of C",
    finds="An array of C. Use `std::array` or `std::vector`; texts of `char` are let be.",
    why="Its size is lost in every call, and nothing checks an index.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2023",
        "autosar-cpp14",
    ),
    clauses=(
        "misra-cpp-2023 11.3.1",
        "autosar-cpp14 A18-1-1",
        "clang-tidy modernize-avoid-c-arrays",
    ),
    bad="int limits[3];\n",
    good="std::array<int, 3> limits;\n",
    syntax="cpp",
    kinds=("array_declarator",),
    in_c=False,
    found=found,
)
