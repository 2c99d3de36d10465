"""Rule ``cpp.using_declaration``: a name that a header takes for all."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import has_token
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import HEADER, Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each using declaration at the level of the file."""
    around = node.parent
    while around is not None and around.type.startswith("preproc"):
        around = around.parent
    if around is not None and around.type == "translation_unit" and not has_token(node, "namespace"):
        yield view.hit(
            "cpp.using_declaration", node, f"`{view.text(node)}` in a header; expected the whole name", only=HEADER
        )


RULE = FileRule(
    id="cpp.using_declaration",
    title="Using declaration in a header",
    finds="`using std::string;` at the level of the file in a header. Write the name out, or put it into a namespace.",
    why="Every file that includes the header has the name.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "autosar-cpp14",
        "safety",
    ),
    tags=("header",),
    clauses=(
        "misra-cpp-2008 7-3-6",
        "autosar-cpp14 M7-3-6",
        "clang-tidy google-global-names-in-headers",
    ),
    bad="#pragma once\nusing std::string;\n",
    good="#pragma once\nnamespace robot { using std::string; }\n",
    syntax="cpp",
    kinds=("using_declaration",),
    found=found,
)
