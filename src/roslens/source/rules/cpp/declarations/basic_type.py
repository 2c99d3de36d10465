"""Rule ``cpp.basic_type``: a number whose size depends on the platform."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_INTEGER = re.compile(rb"\b(?:unsigned|signed|short|long|int)\b")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each integer type that does not say its size."""
    seen = -1
    for _match, node in places(_INTEGER, view):
        one = node if node.type in ("primitive_type", "sized_type_specifier") else node.parent
        if one is None or one.start_byte <= seen or one.type not in ("primitive_type", "sized_type_specifier"):
            continue
        if one.parent is not None and one.parent.type == "sized_type_specifier":
            one = one.parent
        seen = one.start_byte
        text = view.text(one)
        is_main = re.match(rb"\s*(?:main\s*\(|argc\b|\))", view.code[one.end_byte : one.end_byte + 40])
        if not is_main and "char" not in text and "double" not in text:
            yield view.hit("cpp.basic_type", one, f"`{text}` does not say its size; expected a type of <cstdint>")


RULE = FileRule(
    id="cpp.basic_type",
    title="Integer type without a size",
    finds="`int`, `short`, `long`, `unsigned` and `signed`. Use a type of `<cstdint>`; `int main` and "
    "`operator++(int)` are let be.",
    why="The code moves from the computer of the robot to a microcontroller, where `int` has 16 bits.",
    severity=Severity.NOTE,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
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
    found=found,
)
