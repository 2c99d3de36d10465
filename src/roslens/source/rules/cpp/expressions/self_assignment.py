"""Rule ``cpp.self_assignment``: a variable that is assigned to itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.finding import Severity
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
        message = f"`{view.text(node)[:60]}` does nothing; expected another side"
        severity = Severity.NOTE if _is_all_of_else(node) else None
        yield view.hit("cpp.self_assignment", node, message, severity=severity)


def _is_all_of_else(node: Node) -> bool:
    """Return whether it is all that an ``else`` or a ``:`` does: it says that nothing is to be done."""
    statement = node.parent
    if statement is not None and statement.type == "conditional_expression":
        return True
    block = statement.parent if statement is not None else None
    if block is not None and block.type == "compound_statement" and block.named_child_count == 1:
        block = block.parent
    return block is not None and block.type == "else_clause"


RULE = FileRule(
    id="cpp.self_assignment",
    title="Assignment of a variable to itself",
    finds="`x = x;`: a member and a parameter of the same name, or the wrong name. Write `this->x = x` or what "
    "was meant.",
    why="The value that was configured is thrown away, and the default stays.",
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
