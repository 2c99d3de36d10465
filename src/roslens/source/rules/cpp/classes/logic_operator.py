"""Rule ``cpp.logic_operator``: an operator that no longer stops early."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such overload."""
    name = view.text(node).replace(" ", "")
    if name in ("operator&&", "operator||", "operator,"):
        yield view.hit("cpp.logic_operator", node, f"`{name}` evaluates both sides; expected a function with a name")


RULE = FileRule(
    id="cpp.logic_operator",
    title="`&&`, `||` or `,` overloaded",
    finds="An overload of `operator&&`, `operator||` or `operator,`. Both sides are always evaluated, in any "
    "order. Write a function with a name.",
    why="`if (valid && read())` reads although it is not valid.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
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
        "misra-cpp-2008 5-2-11",
        "misra-cpp-2023 16.5.1",
        "autosar-cpp14 M5-2-11",
        "jsf-av 159",
        "hicpp 13.2.1",
        "paper2016 harosOverrideBinaryAnd",
        "paper2016 harosOverrideBinaryOr",
        "paper2016 harosOverrideComma",
    ),
    bad="bool operator&&(A a, A b);\n",
    good="bool both(A a, A b);\n",
    syntax="cpp",
    kinds=("operator_name",),
    found=found,
)
