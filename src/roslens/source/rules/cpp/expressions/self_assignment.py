"""Rule ``cpp.self_assignment``: a variable that is assigned to itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import is_written_twice
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each assignment with ``=`` whose two sides are written alike."""
    for node in nodes:
        left = node.child_by_field_name("left")
        if left is not None and is_written_twice(left, node, view):
            yield from _found(node, left, view)


def _found(node: Node, left: Node, view: FileView) -> Iterator[Hit]:
    if view.text(node.child_by_field_name("operator")) != "=":
        return
    text = view.text(left)
    if "++" not in text and "--" not in text and text:
        message = f"`{view.short(node)}` does nothing; expected another side"
        yield view.hit("cpp.self_assignment", node, message)


RULE = FileRule(
    id="cpp.self_assignment",
    title="Assignment of a variable to itself",
    finds="`x = x;`: a member and a parameter of the same name, or the wrong name. Write `this->x = x` or what "
    "was meant.",
    why="The value that was configured is thrown away, and the default stays. Most say that nothing is to be done, or "
    "silence a warning: it is a note.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy clang-diagnostic-self-assign",),
    bad="void A::set(int rate) { rate = rate; }\n",
    good="void A::set(int rate) { this->rate = rate; }\n",
    syntax="cpp",
    kinds=("assignment_expression",),
    found_among=found_among,
)
