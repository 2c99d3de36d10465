"""Rule ``cpp.union``: two things in one place."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each union."""
    if node.child_by_field_name("body") is not None:
        yield view.hit(
            "cpp.union", node, f"`union {view.text(node.child_by_field_name('name'))}`; expected std::variant"
        )


RULE = FileRule(
    id="cpp.union",
    title="Union",
    finds="A `union`. Use `std::variant`, or `std::memcpy` to read bytes as something else.",
    why="Only the writer knows which member is valid; reading another one is undefined behaviour.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 9-5-1",
        "misra-cpp-2023 12.3.1",
        "autosar-cpp14 A9-5-1",
        "jsf-av 153",
        "paper2016 harosUnion",
        "clang-tidy cppcoreguidelines-pro-type-union-access",
    ),
    bad="union Word { int number; char bytes[4]; };\n",
    good="struct Word { int number; };\n",
    syntax="cpp",
    kinds=("union_specifier",),
    found=found,
)
