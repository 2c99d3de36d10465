"""Rule ``cpp.const_move``: a value that cannot be moved out of."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_MOVED = re.compile(rb"(array)\s*<[^;{}()]*>\s*&&")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such parameter."""
    for _match, node in places(_MOVED, view, 1):
        around = above(node, "parameter_declaration", "declaration", "field_declaration", "compound_statement")
        if around is not None and around.type == "parameter_declaration":
            yield view.hit(
                "cpp.const_move",
                around,
                f"`{view.short(around)}` moves nothing; expected a reference to const",
            )


RULE = FileRule(
    id="cpp.const_move",
    title="`std::array` by reference to temporaries",
    finds="A parameter `std::array<…>&&`: moving an array copies each element. Take it by reference to const.",
    why="It promises a speed that is not there.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("paper2016",),
    clauses=("paper2016 harosRvalueStdArray",),
    bad="void f(std::array<int, 3>&& a);\n",
    good="void f(const std::array<int, 3>& a);\n",
    syntax="cpp",
    whole=True,
    words=("array",),
    found=found,
)
