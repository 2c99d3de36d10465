"""Rule ``cpp.make_pair``: types where they are deduced."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call with types."""
    if node.parent is not None and node.parent.type == "template_function":
        yield view.hit(
            "cpp.make_pair",
            node.parent,
            f"`{view.short(node.parent)}`; expected `make_pair` without types, or `std::pair<…>`",
            edits=_edits(node, view),
        )


def _edits(node: Node, view: FileView) -> tuple[Edit, ...]:
    whole = whole_name(node)
    text = view.text(whole).replace(" ", "")
    if not text.startswith("std::make_pair<") or text.count(",") != 1 or set("&[") & set(text):
        return ()
    return view.edits((node.start_byte, node.end_byte, "pair"))


RULE = FileRule(
    id="cpp.make_pair",
    title="`make_pair` with types",
    finds="`std::make_pair<A, B>(a, b)` copies what it should move, or does not compile. Leave the types out, "
    "or write `std::pair<A, B>(a, b)`.",
    why="It is a compile error with one compiler and a copy with another.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint build/explicit_make_pair",
        "paper2016 make_pair_template",
    ),
    fix="Writes `std::pair<A, B>(a, b)`, which is of the same type.",
    bad="auto f(int a) { return std::make_pair<int, int>(a, 3); }\n",
    good="auto f(int a) { return std::make_pair(a, 3); }\n",
    syntax="cpp",
    anchors=("make_pair",),
    in_c=False,
    found=found,
)
