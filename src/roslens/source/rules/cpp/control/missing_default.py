"""Rule ``cpp.missing_default``: a choice that leaves a value out."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each switch without a default."""
    if not re.search(rb"\bdefault\s*:", view.code[node.start_byte : node.end_byte]):
        yield view.hit(
            "cpp.missing_default", node, "`switch` without `default`; expected one that handles what is left"
        )


RULE = FileRule(
    id="cpp.missing_default",
    title="`switch` without `default`",
    finds="A `switch` without a `default`. Add one; where all values of an enumeration are handled, let it "
    "report the impossible.",
    why="A message of a newer version has a mode that is not handled, and no error is reported.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 6-4-6",
        "autosar-cpp14 M6-4-6",
        "jsf-av 194",
        "hicpp 6.1.2",
        "clang-tidy hicpp-multiway-paths-covered",
    ),
    bad="void f(int a) { switch (a) { case 1: g(); break; case 2: h(); break; } }\n",
    good="void f(int a) { switch (a) { case 1: g(); break; default: h(); break; } }\n",
    syntax="cpp",
    kinds=("switch_statement",),
    found=found,
)
