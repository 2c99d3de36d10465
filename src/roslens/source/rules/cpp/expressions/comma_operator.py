"""Rule ``cpp.comma_operator``: two expressions where one is expected."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each comma that separates expressions, but for the head of a loop."""
    around = node.parent
    if around is not None and around.type in ("for_statement", "comma_expression", "argument_list"):
        return
    first = node.child_by_field_name("left")
    while first is not None and first.type == "comma_expression":
        first = first.child_by_field_name("left")
    if first is not None and (
        first.type != "binary_expression" or view.text(first.child_by_field_name("operator")) != "<<"
    ):
        yield view.hit(
            "cpp.comma_operator",
            node,
            f"`{view.short(node)}` are two expressions; expected two statements",
        )


RULE = FileRule(
    id="cpp.comma_operator",
    title="Comma operator",
    finds="The comma operator outside of the head of a `for`. Lists such as `matrix << 1, 2;` of Eigen are let "
    "be. Write two statements.",
    why="What looks like an argument or a condition is thrown away: `at(i, j)` and `at[i, j]` are not the same.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
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
