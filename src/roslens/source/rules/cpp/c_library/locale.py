"""Rule ``cpp.locale``: a locale for the whole process."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call of one of these functions."""
    if free_call(node, view) is not None:
        yield view.hit(
            "cpp.locale", node, f"`{view.text(node)}` changes the whole process; expected a std::locale of one stream"
        )


RULE = FileRule(
    id="cpp.locale",
    title="`setlocale`",
    finds="`setlocale` changes how numbers are read and written in the whole process.",
    why="Where the decimal point becomes a comma, calibration files are read wrongly.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "jsf-av 19",
        "autosar-cpp14 A18-0-3",
        "misra-cpp-2023 25.5.1",
    ),
    bad='void f() { setlocale(LC_ALL, "de_DE"); }\n',
    good="void f(std::ostream& out) { out.imbue(std::locale::classic()); }\n",
    syntax="cpp",
    anchors=("setlocale",),
    found=found,
)
