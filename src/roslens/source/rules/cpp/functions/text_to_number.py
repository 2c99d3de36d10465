"""Rule ``cpp.text_to_number``: a conversion that cannot say that it failed."""

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
            "cpp.text_to_number",
            node,
            f"`{view.text(node)}` cannot say that the text is no number; expected std::stoi or std::from_chars",
        )


RULE = FileRule(
    id="cpp.text_to_number",
    title="`atoi`, `atof` and `atol`",
    finds="`atoi`, `atol`, `atoll` and `atof` give 0 for a text that is no number, and are undefined out of "
    "range. Use `std::stoi`, `std::strtol` or `std::from_chars`, and check.",
    why="A mistyped parameter becomes a rate or a limit of 0.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 18-0-2",
        "misra-cpp-2023 21.2.1",
        "autosar-cpp14 A18-0-2",
        "jsf-av 23",
        "clang-tidy cert-err34-c",
    ),
    bad="int f(const char* text) { return atoi(text); }\n",
    good="int f(const char* text) { return std::stoi(text); }\n",
    syntax="cpp",
    anchors=(
        "atoi",
        "atol",
        "atof",
        "atoll",
    ),
    found=found,
)
