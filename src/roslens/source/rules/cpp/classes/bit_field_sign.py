"""Rule ``cpp.bit_field_sign``: bits whose sign nobody knows."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each bit-field of a type that does not say its sign."""
    around = node.parent
    kind = view.text(around.child_by_field_name("type")) if around is not None else ""
    if around is not None and kind in ("int", "short", "long", "char", "long long"):
        yield view.hit(
            "cpp.bit_field_sign",
            around,
            f"`{view.short(around)}` does not say its sign; expected unsigned, or a type of <cstdint>",
        )


RULE = FileRule(
    id="cpp.bit_field_sign",
    title="Bit-field without a sign",
    finds="A bit-field of `int`, `short`, `long` or `char`: whether it is signed is up to the compiler. Write "
    "`unsigned` or a type of `<cstdint>`.",
    why="One bit of `int` is 0 or -1, never 1.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "jsf-av 154",
        "hicpp 9.2.1",
    ),
    bad="struct A { int ready : 1; };\n",
    good="struct A { unsigned ready : 1; };\n",
    syntax="cpp",
    kinds=("bitfield_clause",),
    found=found,
)
