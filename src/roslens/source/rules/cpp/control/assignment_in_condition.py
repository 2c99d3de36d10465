"""Rule ``cpp.assignment_in_condition``: an assignment where a comparison was meant."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_CONSTANT = re.compile(r"[-+]?(?:\d[\w.]*|true|false|nullptr|NULL|'(?:\\?.)'|(?:\w+::)*(?:[A-Z][A-Z0-9_]*|k[A-Z]\w*))")
"""A literal, or a name that is written as those of constants are."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a condition that is an assignment with ``=`` and nothing else."""
    condition = node.child_by_field_name("condition")
    value = condition.child_by_field_name("value") if condition is not None else None
    value = value if value is not None or condition is None else next(iter(condition.named_children), None)
    if value is None or value.type != "assignment_expression":
        return
    if view.text(value.child_by_field_name("operator")) == "=":
        # Nobody assigns a constant to ask for it; what a function returns may be meant.
        is_constant = _CONSTANT.fullmatch(view.text(value.child_by_field_name("right"))) is not None
        always = ": it has one result whatever the value was" if is_constant else ""
        yield view.hit(
            "cpp.assignment_in_condition",
            value,
            f"`{view.short(value)}` assigns in a condition{always}; expected `==`, or parentheses around it",
            certainty=None if is_constant else Certainty.HEURISTIC,
        )


RULE = FileRule(
    id="cpp.assignment_in_condition",
    title="Assignment as a condition",
    finds="`if (a = b)` or `while (a = b)` without a second pair of parentheses. Write `==`, or assign before. "
    "It is a note unless what is assigned is a literal or a constant.",
    why="The state of the robot is overwritten by the test for it, and the branch is taken always or never.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 6-2-1",
        "misra-cpp-2023 8.18.2",
        "autosar-cpp14 M6-2-1",
        "jsf-av 160",
        "paper2016 harosAssignAssignment",
        "clang-tidy bugprone-assignment-in-if-condition",
    ),
    bad="void f(int a) { if (a = 3) stop(); }\n",
    good="void f(int a) { if (a == 3) stop(); }\n",
    syntax="cpp",
    kinds=(
        "(if_statement (condition_clause (assignment_expression))) @node",
        "(while_statement (condition_clause (assignment_expression))) @node",
    ),
    found=found,
)
