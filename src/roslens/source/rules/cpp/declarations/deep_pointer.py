"""Rule ``cpp.deep_pointer``: a pointer to a pointer to a pointer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.cpp.declarations.pointer_depth import DOUBLE_POINTERS
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_POINTERS = re.compile(rb"(\*\s*\*\s*\*)")


def found_among(_nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each declarator with three levels of pointers."""
    for _match, node in places(_POINTERS, view, 1):
        one = node if node.type.endswith("pointer_declarator") else node.parent
        if one is not None and one.type.endswith("pointer_declarator"):
            around = above(one, "parameter_declaration", "declaration", "field_declaration", "type_definition")
            yield view.hit(
                "cpp.deep_pointer",
                one,
                f"`{view.short(around)}` has three levels of pointers; expected a container",
            )


RULE = FileRule(
    id="cpp.deep_pointer",
    title="Three levels of pointers",
    finds="A declaration with three or more levels of pointers. Use a container or a struct.",
    why="Who owns which level is a guess.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 5-0-19",
        "misra-cpp-2023 11.3.2",
        "autosar-cpp14 A5-0-3",
        "jsf-av 170",
        "paper2016 harosTriplePointer",
    ),
    bad="void f(char*** names);\n",
    good="void f(const Names& names);\n",
    syntax="cpp",
    kinds=DOUBLE_POINTERS,
    found_among=found_among,
)
