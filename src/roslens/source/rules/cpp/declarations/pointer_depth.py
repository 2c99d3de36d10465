"""Rule ``cpp.pointer_depth``: a pointer to a pointer."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_POINTERS = re.compile(rb"(\*\s*(?:const\s*)?\*+)")

DOUBLE_POINTERS = (
    "(pointer_declarator (pointer_declarator)) @node",
    "(abstract_pointer_declarator (abstract_pointer_declarator)) @node",
)
"""A file without any has no two stars that are both of a declarator."""


def found_among(_nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each declarator with two levels of pointers."""
    for _match, node in places(_POINTERS, view, 1):
        one = node if node.type.endswith("pointer_declarator") else node.parent
        if (
            one is None
            or not one.type.endswith("pointer_declarator")
            or (one.parent is not None and one.parent.type == one.type)
        ):
            continue
        around = above(
            one, "parameter_declaration", "declaration", "field_declaration", "type_definition", "type_descriptor"
        )
        text = view.short(around)
        if around is not None and "argv" not in text:
            levels = _levels(one)
            yield view.hit(
                "cpp.pointer_depth",
                one,
                f"`{text}` has {levels} levels of pointers; expected a container or a reference",
            )


def _levels(declarator: Node) -> int:
    count, one = 0, declarator
    while one.type.endswith("pointer_declarator"):
        count += 1
        inner = next((child for child in one.named_children if child.type.endswith("declarator")), None)
        if inner is None:
            break
        one = inner
    return count


RULE = FileRule(
    id="cpp.pointer_depth",
    title="Pointer to a pointer",
    finds="A declaration with two or more levels of pointers; `char** argv` is let be. Use a container or a reference.",
    why="Who owns which level is a guess.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "jsf-av",
        "paper2016",
    ),
    clauses=(
        "hicpp 8.1.1",
        "jsf-av 169",
        "paper2016 harosDoublePointer",
        "paper2016 harosTriplePointer",
    ),
    bad="void f(char** names);\n",
    good="void f(const std::vector<std::string>& names);\n",
    syntax="cpp",
    kinds=DOUBLE_POINTERS,
    found_among=found_among,
)
