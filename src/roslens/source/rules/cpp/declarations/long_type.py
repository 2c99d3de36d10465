"""Rule ``cpp.long_type``: a type whose size depends on the platform."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each integer type of a size of its own."""
    around = node if node.type in ("sized_type_specifier", "primitive_type") else node.parent
    if around is None or around.type not in ("sized_type_specifier", "primitive_type"):
        return
    text = view.text(around)
    if "double" not in text and (
        text != "unsigned short" or view.code[around.end_byte : around.end_byte + 6].lstrip()[:4] != b"port"
    ):
        yield view.hit("cpp.long_type", around, f"`{text}`; expected int16_t, int64_t or another type of fixed size")


RULE = FileRule(
    id="cpp.long_type",
    title="`short` or `long`",
    finds="`short`, `long` and `long long`. Use `int16_t`, `int64_t` and their like.",
    why="`long` has 32 bits on one computer of the robot and 64 on another.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/int",
        "paper2016 c_types",
        "clang-tidy google-runtime-int",
    ),
    bad="long counter;\n",
    good="int64_t counter;\n",
    syntax="cpp",
    anchors=("short", "long"),
    found=found,
)
