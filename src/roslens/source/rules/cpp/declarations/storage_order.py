"""Rule ``cpp.storage_order``: a storage class behind the type."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.spans import with_space

_TYPE = re.compile(rb"\b(?:const|volatile|auto|char|short|int|long|float|double|bool|void|signed|unsigned)[ \t]+\Z")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each storage class behind a type."""
    before = _TYPE.search(view.code[max(node.start_byte - 12, 0) : node.start_byte])
    if before:
        word = view.text(node)
        yield view.hit(
            "cpp.storage_order",
            node,
            f"`{before[0].decode().strip()} {word}`; expected `{word}` first",
            edits=_edits(node, word, view),
        )


def _edits(node: Node, word: str, view: FileView) -> tuple[Edit, ...]:
    whole = above(node, "declaration", "field_declaration", "function_definition")
    if whole is None or "attribute" in whole.children[0].type:
        return ()
    if {b"\n", b"(", b"{", b"}", b";"} & {bytes([one]) for one in view.code[whole.start_byte : node.start_byte]}:
        return ()
    start = whole.start_byte
    return view.edits((start, start, f"{word} "), (*with_space(view.content, node.start_byte, node.end_byte), ""))


RULE = FileRule(
    id="cpp.storage_order",
    title="Storage class behind the type",
    finds="`int static x`: storage classes stand first.",
    why="It reads as if the type were another one.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "hicpp",
        "paper2016",
    ),
    clauses=(
        "cpplint build/storage_class",
        "hicpp 7.1.3",
        "paper2016 storage_before_type",
    ),
    fix="Puts the storage class first.",
    bad="int static counter;\n",
    good="static int counter;\n",
    syntax="cpp",
    anchors=("static", "extern", "typedef"),
    found=found,
)
