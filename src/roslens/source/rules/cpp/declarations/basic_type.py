"""Rule ``cpp.basic_type``: a number whose size depends on the platform."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_INTEGERS = {word: re.compile(rb"%s(?!\w)" % word) for word in (b"int", b"unsigned", b"signed", b"short", b"long")}

_SIZES = frozenset((b"unsigned", b"signed", b"short", b"long"))
"""Without any of them in a file `int` is a type of its own there."""
_MAIN = re.compile(rb"\s*(?:main\s*\(|argc\b|\))")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each integer type that does not say its size."""
    seen = set()
    is_sized = not view.words.isdisjoint(_SIZES)
    for match in (
        one for word, pattern in _INTEGERS.items() if word in view.words for one in pattern.finditer(view.code)
    ):
        one = _type_at(match.start(), match.end(), view, is_sized=is_sized)
        if one is None or one.start_byte in seen:
            continue
        seen.add(one.start_byte)
        text = view.text(one)
        is_main = _MAIN.match(view.code, one.end_byte, one.end_byte + 40)
        if not is_main and "char" not in text and "double" not in text:
            yield view.hit("cpp.basic_type", one, f"`{text}` does not say its size; expected a type of <cstdint>")


def _type_at(start: int, end: int, view: FileView, *, is_sized: bool) -> Node | None:
    """Return the type that a word belongs to; ``is_sized`` where the file has words like ``long`` at all."""
    before = view.code[max(start - 1, 0) : start]
    if before.isalnum() or before == b"_" or (node := view.node_at(start, end)) is None:
        return None
    one = node if node.type in ("primitive_type", "sized_type_specifier") else node.parent
    if one is None or one.type not in ("primitive_type", "sized_type_specifier"):
        return None
    if is_sized and one.parent is not None and one.parent.type == "sized_type_specifier":
        return one.parent
    return one


RULE = FileRule(
    id="cpp.basic_type",
    title="Integer type without a size",
    finds="`int`, `short`, `long`, `unsigned` and `signed`. Use a type of `<cstdint>`; `int main` and "
    "`operator++(int)` are let be.",
    why="The code moves from the computer of the robot to a microcontroller, where `int` has 16 bits.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 3-9-2",
        "misra-cpp-2023 6.9.2",
        "autosar-cpp14 A3-9-1",
        "jsf-av 209",
        "paper2016 harosIntegerTypes",
    ),
    bad="int counter;\n",
    good="int32_t counter;\n",
    syntax="cpp",
    whole=True,
    words=("int", "unsigned", "signed", "short", "long"),
    found=found,
)
