"""Rule ``cpp.throw_in_destructor``: a destructor that throws."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import function_declarator, name_node
from roslens.source.rules.file_view import FileView, all_above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``throw`` below a destructor that nothing around it can catch."""
    for one in all_above(node):
        if one.type in ("try_statement", "lambda_expression"):
            return
        if one.type == "function_definition":
            declarator = function_declarator(one)
            name = view.text(name_node(declarator))
            if name.rpartition("::")[2].startswith("~") and "noexcept(false)" not in view.text(declarator):
                yield view.hit(
                    "cpp.throw_in_destructor", node, f"`throw` in `{name}`; expected a log: destructors must not throw"
                )
            return


RULE = FileRule(
    id="cpp.throw_in_destructor",
    title="Destructor that throws",
    finds="A `throw` in a destructor, outside of a `try` in it. Destructors are `noexcept`: the process ends. "
    "Log and go on.",
    why="The node ends by `std::terminate` while it cleans up after another error, with motors as they were.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 15-5-1",
        "misra-cpp-2023 18.4.1",
        "autosar-cpp14 A15-5-1",
        "hicpp 15.2.1",
        "clang-tidy bugprone-exception-escape",
    ),
    bad="struct A { ~A() { throw 3; } };\n",
    good='struct A { ~A() { log("3"); } };\n',
    syntax="cpp",
    kinds=("throw_statement",),
    found=found,
)
