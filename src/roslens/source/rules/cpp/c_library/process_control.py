"""Rule ``cpp.process_control``: a call that ends or starts processes."""

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
            "cpp.process_control",
            node,
            f"`{view.text(node)}` reaches out of the program; expected an error that is returned, or a parameter",
        )


RULE = FileRule(
    id="cpp.process_control",
    title="`abort`, `exit`, `getenv` or `system`",
    finds="`abort`, `exit` and `system` end or start processes from anywhere, and `getenv` depends on the "
    "surroundings. Return an error, use parameters.",
    why="A library that calls `exit` takes every node of the process with it, without stopping a motor.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 18-0-3",
        "autosar-cpp14 M18-0-3",
        "jsf-av 24",
        "clang-tidy concurrency-mt-unsafe",
    ),
    bad="void f() { exit(1); }\n",
    good="bool f() { return false; }\n",
    syntax="cpp",
    anchors=(
        "abort",
        "exit",
        "quick_exit",
        "_exit",
        "getenv",
        "system",
    ),
    found=found,
)
