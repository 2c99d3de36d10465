"""Rule ``cpp.comma_operator``: two expressions where one is expected."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each comma that separates expressions, but for the head of a loop."""
    if node.parent is None or node.parent.type not in ("for_statement", "comma_expression"):
        yield view.hit("cpp.comma_operator", node, f"`{view.text(node)[:60]}`; expected two statements")


RULE = FileRule(
    id="cpp.comma_operator",
    title="Comma operator",
    finds="The comma operator outside of the head of a `for`. Write two statements.",
    why="What looks like an argument or a condition is thrown away: `at(i, j)` and `at[i, j]` are not the same.",
    severity=Severity.NOTE,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 5-18-1",
        "misra-cpp-2023 8.19.1",
        "autosar-cpp14 M5-18-1",
        "jsf-av 168",
    ),
    bad="void f(int a, int b) { a = 1, b = 2; }\n",
    good="void f(int a, int b) { a = 1; b = 2; }\n",
    syntax="cpp",
    kinds=("comma_expression",),
    found=found,
)
