"""Rule ``cpp.float_equality``: numbers with a fraction that are compared for equality."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_COMPARED = re.compile(
    rb"[=!]=\s*-?(?:\d+\.\d*|\.\d+)(?:[eE][-+]?\d+)?[fFlL]?(?![\w.])|(?<![\w.])(?:\d+\.\d*|\.\d+)(?:[eE][-+]?\d+)?[fFlL]?\s*[=!]=(?!=)"
)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each comparison with a literal that has a fraction."""
    for _match, node in places(_COMPARED, view):
        around = node if node.type == "binary_expression" else above(node, "binary_expression", "compound_statement")
        if around is not None and around.type == "binary_expression":
            yield view.hit(
                "cpp.float_equality", around, f"`{view.text(around)[:60]}` compares for equality; expected a tolerance"
            )


RULE = FileRule(
    id="cpp.float_equality",
    title="Floating-point numbers compared with `==`",
    finds="`==` or `!=` with a floating-point literal. Compare the difference with a tolerance.",
    why="`angle == 0.1` is never true after a rotation there and back.",
    severity=Severity.NOTE,
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
    whole=True,
    found=found,
)
