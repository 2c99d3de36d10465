"""Rule ``cpp.missing_virtual``: an overriding function without `virtual`."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import has_token
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each declaration with override and without virtual."""
    declarator = node.parent
    around = above(node, "field_declaration", "declaration", "function_definition")
    if (
        declarator is not None
        and declarator.type == "function_declarator"
        and around is not None
        and not has_token(around, "virtual")
    ):
        yield view.hit(
            "cpp.missing_virtual",
            declarator,
            f"`{view.short(declarator)}` overrides; expected `virtual` in front",
            edits=()
            if "attribute" in around.children[0].type
            else view.edits((around.start_byte, around.start_byte, "virtual ")),
        )


RULE = FileRule(
    id="cpp.missing_virtual",
    title="Overriding function without `virtual`",
    finds="`override` without `virtual`: MISRA C++:2008, which knows no `override`, asks for `virtual` on each "
    "overriding function.",
    why="A reader of C++03 looks for the word.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("misra-cpp-2008",),
    clauses=("misra-cpp-2008 10-3-2",),
    unlike=("cpp.redundant_virtual",),
    fix="Adds `virtual`.",
    bad="struct B : A { void stop() override; };\n",
    good="struct B : A { virtual void stop() override; };\n",
    syntax="cpp",
    kinds=("virtual_specifier",),
    found=found,
)
