"""Rule ``cpp.address_operator``: an address that is none."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import enclosing_class, parameters_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each overload that takes no second operand."""
    function = node.parent
    if view.text(node).replace(" ", "") != "operator&" or function is None or function.type != "function_declarator":
        return
    operands = len(parameters_of(function)) + (enclosing_class(function) is not None)
    if operands == 1:
        yield view.hit(
            "cpp.address_operator", function, "unary `operator&` hides the address; expected a function with a name"
        )


RULE = FileRule(
    id="cpp.address_operator",
    title="Unary `&` overloaded",
    finds="An overload of the unary `operator&`. Write a function with a name.",
    why="Code that takes the address of an object gets something else.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/operator",
        "misra-cpp-2008 5-3-3",
        "misra-cpp-2023 16.5.2",
        "autosar-cpp14 M5-3-3",
        "jsf-av 159",
        "hicpp 13.2.1",
        "paper2016 unary_and",
        "paper2016 harosOverrideUnaryAnd",
        "clang-tidy google-runtime-operator",
    ),
    bad="struct A { A* operator&(); };\n",
    good="struct A { A* address(); };\n",
    syntax="cpp",
    kinds=("operator_name",),
    found=found,
)
