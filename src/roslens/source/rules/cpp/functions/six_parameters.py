"""Rule ``cpp.six_parameters``: a function that takes much."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_class import function_declarator, name_node, parameters_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each function with more than six parameters."""
    for node in nodes:
        body = node.child_by_field_name("body")
        if body is None or view.code.count(b",", node.start_byte, body.start_byte) < 6:
            continue
        declarator = function_declarator(node)
        count = len(parameters_of(declarator)) if declarator is not None else 0
        if declarator is not None and count > 6:
            name = view.text(name_node(declarator))
            yield view.hit(
                "cpp.six_parameters", declarator, f"{count} parameters (limit 6) in `{name}`; expected a struct"
            )


RULE = FileRule(
    id="cpp.six_parameters",
    title="More than six parameters",
    finds="A function with more than six parameters. Pass a struct.",
    why="If two of seven numbers are swapped at a call, it goes unnoticed.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "paper2016",
    ),
    clauses=(
        "hicpp 8.2.2",
        "paper2016 harosSixParams",
        "clang-tidy readability-function-size",
    ),
    bad="void f(int a, int b, int c, int d, int e, int g, int h) {}\n",
    good="void f(const Limits& limits) {}\n",
    syntax="cpp",
    kinds=("function_definition",),
    found_among=found_among,
)
