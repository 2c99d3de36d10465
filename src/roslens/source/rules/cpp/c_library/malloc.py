"""Rule ``cpp.malloc``: memory that no object owns."""

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
            "cpp.malloc",
            node,
            f"`{view.text(node)}` takes or frees memory by hand; expected a container or std::make_unique",
        )


RULE = FileRule(
    id="cpp.malloc",
    title="`malloc` and `free` in C++",
    finds="`malloc`, `calloc`, `realloc` and `free`: no constructor runs and nothing owns the memory. Use a "
    "container or `std::make_unique`.",
    why="Every early return of a callback loses the memory; a node that runs for weeks ends.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "autosar-cpp14 A18-5-1",
        "misra-cpp-2023 21.6.1",
        "hicpp 5.3.2",
        "clang-tidy cppcoreguidelines-no-malloc",
    ),
    bad="void f() { char* p = (char*)malloc(3); }\n",
    good="void f() { std::vector<char> p(3); }\n",
    syntax="cpp",
    anchors=(
        "malloc",
        "calloc",
        "realloc",
        "free",
    ),
    in_c=False,
    found=found,
)
