"""Rule ``cpp.rand``: numbers by chance that are few."""

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
            "cpp.rand", node, f"`{view.text(node)}` draws from one state for the whole process; expected <random>"
        )


RULE = FileRule(
    id="cpp.rand",
    title="`rand` and `srand`",
    finds="`rand` has few values on some platforms, one state for all threads, and is seeded by `srand` for "
    "everybody. Use `<random>`.",
    why="Particle filters that draw with `rand` repeat themselves and differ from platform to platform.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "autosar-cpp14 A26-5-1",
        "clang-tidy cert-msc50-cpp",
    ),
    bad="int f() { return rand() % 6; }\n",
    good="int f(std::mt19937& engine) { return std::uniform_int_distribution<int>(0, 5)(engine); }\n",
    syntax="cpp",
    anchors=(
        "rand",
        "srand",
        "random_shuffle",
    ),
    in_c=False,
    found=found,
)
