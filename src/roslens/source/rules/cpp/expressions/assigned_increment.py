"""Rule ``cpp.assigned_increment``: a change that is thrown away."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each assignment of an increment of the same variable."""
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    if left is None or right is None or right.type != "update_expression":
        return
    name, operator = view.text(left), view.text(right.child_by_field_name("operator"))
    # `i = ++i` is odd, but does what it says.
    if view.text(right.child_by_field_name("argument")) == name and view.text(right).endswith(operator):
        yield view.hit(
            "cpp.assigned_increment",
            node,
            f"`{view.short(node)}` throws the change away; expected `{operator}{shortened(name, 30)}`",
        )


RULE = FileRule(
    id="cpp.assigned_increment",
    title="Variable assigned its own increment",
    finds="`i = i++;`. Write `++i;`.",
    why="Before C++17 it is undefined, since then `i = i++` does nothing: the counter stands still.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "safety",
        "paper2016",
    ),
    clauses=(
        "paper2016 harosAssignIncrement",
        "clang-tidy clang-diagnostic-unsequenced",
    ),
    bad="void f(int i) { i = i++; }\n",
    good="void f(int i) { ++i; }\n",
    syntax="cpp",
    kinds=("(assignment_expression right: (update_expression)) @node",),
    found=found,
)
