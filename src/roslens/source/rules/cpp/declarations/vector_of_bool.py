"""Rule ``cpp.vector_of_bool``: a vector that is none."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_BITS = re.compile(rb"(vector)\s*<\s*bool\s*[>,]")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such type."""
    for _match, node in places(_BITS, view, 1):
        if node.type == "type_identifier":
            yield view.hit(
                "cpp.vector_of_bool", node, "`vector<bool>` holds bits; expected vector<char> or std::bitset"
            )


RULE = FileRule(
    id="cpp.vector_of_bool",
    title="`std::vector<bool>`",
    finds="`std::vector<bool>` holds bits: its elements are no `bool`, and two threads cannot write two of "
    "them. Use `std::vector<char>`, `std::bitset` or `std::deque<bool>`.",
    why="Two callbacks that set two flags of their own lose one.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    clauses=(
        "hicpp 17.1.1",
        "misra-cpp-2023 26.3.1",
        "autosar-cpp14 A18-1-2",
        "paper2016 harosBooleanVector",
    ),
    bad="std::vector<bool> flags;\n",
    good="std::vector<char> flags;\n",
    syntax="cpp",
    whole=True,
    words=("vector",),
    found=found,
)
