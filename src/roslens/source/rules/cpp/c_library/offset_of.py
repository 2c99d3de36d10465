"""Rule ``cpp.offset_of``: a distance in a class."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each use of it."""
    if node.type in ("offsetof", "identifier", "offsetof_expression"):
        yield view.hit("cpp.offset_of", node, "`offsetof`; expected a pointer to the member")


RULE = FileRule(
    id="cpp.offset_of",
    title="`offsetof`",
    finds="`offsetof`. Use a pointer to the member.",
    why="In a class with a base class or a virtual function it is undefined.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 18-2-1",
        "misra-cpp-2023 21.2.4",
        "autosar-cpp14 M18-2-1",
        "jsf-av 18",
    ),
    bad="int f() { return offsetof(A, b); }\n",
    good="int A::* f() { return &A::b; }\n",
    syntax="cpp",
    anchors=("offsetof",),
    found=found,
)
