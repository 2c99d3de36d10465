"""Rule ``cpp.float_equality``: numbers with a fraction that are compared for equality."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NUMBER = rb"(?:\d+\.\d*|\.\d+)(?:[eE][-+]?\d+)?[fFlL]?"
_BEHIND = re.compile(rb"\s*-?" + _NUMBER + rb"(?![\w.])")
_BEFORE = re.compile(rb"(?<![\w.])" + _NUMBER + rb"\s*\Z")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each comparison with a literal that has a fraction."""
    around = node.parent
    if around is None or around.type != "binary_expression":
        return
    code = view.code
    if _BEHIND.match(code, node.end_byte) or _BEFORE.search(code[max(node.start_byte - 24, 0) : node.start_byte]):
        yield view.hit(
            "cpp.float_equality",
            around,
            f"`{view.short(around)}` compares for equality; expected a tolerance",
        )


RULE = FileRule(
    id="cpp.float_equality",
    title="Floating-point numbers compared with `==`",
    finds="`==` or `!=` with a floating-point literal. Compare the difference with a tolerance.",
    why="`angle == 0.1` is never true after a rotation there and back.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 6-2-2",
        "autosar-cpp14 M6-2-2",
        "jsf-av 202",
        "hicpp 5.7.1",
        "paper2016 harosFloatEquality",
        "clang-tidy clang-diagnostic-float-equal",
    ),
    bad="bool f(double x) { return x == 0.1; }\n",
    good="bool f(double x) { return std::abs(x - 0.1) < 1e-9; }\n",
    syntax="cpp",
    anchors=("==", "!="),
    found=found,
)
