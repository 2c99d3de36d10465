"""Rule ``cpp.implicit_conversion``: a conversion that nobody asked for."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import enclosing_class, has_token
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each conversion that happens by itself."""
    around = above(node, "field_declaration", "declaration", "function_definition", "field_declaration_list")
    if around is None or around.type == "field_declaration_list" or has_token(around, "explicit_function_specifier"):
        return
    if enclosing_class(node) is not None:
        text = view.short(node)
        yield view.hit("cpp.implicit_conversion", node, f"`{text}` converts by itself; expected `explicit`")


RULE = FileRule(
    id="cpp.implicit_conversion",
    title="Conversion operator without `explicit`",
    finds="`operator T()` without `explicit`. Add `explicit`, or write a function with a name.",
    why="A handle becomes a number in an expression, and compiles.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2023 15.1.3",
        "autosar-cpp14 A13-5-2",
        "jsf-av 177",
        "hicpp 12.1.1",
        "clang-tidy google-explicit-constructor",
    ),
    bad="struct A { operator int() const; };\n",
    good="struct A { explicit operator int() const; };\n",
    syntax="cpp",
    kinds=("operator_cast",),
    found=found,
)
