"""Rule ``cpp.variadic``: a function that takes anything."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each function with an ellipsis."""
    listed = node.parent
    if node.type == "..." and listed is not None and listed.type == "parameter_list":
        function = listed.parent
        if function is not None and function.type == "function_declarator":
            name = view.text(name_node(function))
            yield view.hit("cpp.variadic", function, f"`{name}` takes `...`; expected a variadic template")


RULE = FileRule(
    id="cpp.variadic",
    title="Function with `...`",
    finds="A function with an ellipsis. Use a variadic template or `std::initializer_list`.",
    why="A number of the wrong size in the arguments shifts all that follow.",
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
        "misra-cpp-2008 8-4-1",
        "misra-cpp-2023 8.2.11",
        "autosar-cpp14 A8-4-1",
        "jsf-av 108",
        "hicpp 14.1.1",
        "clang-tidy cert-dcl50-cpp",
    ),
    bad="void log(const char* form, ...);\n",
    good="template <typename... T>\nvoid log(const char* form, T... values);\n",
    syntax="cpp",
    anchors=("...",),
    in_c=False,
    found=found,
)
