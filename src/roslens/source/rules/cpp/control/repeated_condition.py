"""Rule ``cpp.repeated_condition``: a branch that is never taken, because an earlier one asks the same."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_DIRECTIVE = re.compile(rb"^[ \t]*#", re.MULTILINE)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each condition of a chain that stands in it before."""
    if node.parent is not None and node.parent.type == "else_clause":
        return
    if node.child_by_field_name("alternative") is None:
        return
    seen: dict[str, int] = {}
    moved_on = False
    if _DIRECTIVE.search(view.content, node.start_byte, node.end_byte):
        # Of branches between `#ifdef` and `#endif` only one may be built.
        return
    for condition in _conditions(node):
        text = " ".join(view.content[condition.start_byte : condition.end_byte].decode("utf-8", "replace").split())
        if text in seen and _is_pure(text) and not (moved_on and "(" in text[1:]):
            yield view.hit(
                "cpp.repeated_condition",
                condition,
                f"`{shortened(text, 60)}` is asked on line {seen[text]} too; expected another condition",
            )
        seen.setdefault(text, view.place(condition.start_byte)[0])
        moved_on = moved_on or not _is_pure(text)


def _conditions(node: Node) -> Iterator[Node]:
    """Yield the conditions of a chain of branches."""
    one: Node | None = node
    while one is not None and one.type == "if_statement":
        condition, other = one.child_by_field_name("condition"), one.child_by_field_name("alternative")
        if condition is not None:
            yield condition
        one = next((child for child in other.named_children if child.type == "if_statement"), None) if other else None


def _is_pure(text: str) -> bool:
    """Return whether asking twice gives the same: nothing is called that may have moved on."""
    return (
        "++" not in text
        and "--" not in text
        and not re.search(r"[^=!<>]=[^=]|\b(?:read|next|get|pop|poll|wait|try|recv)\w*\(", text)
    )


RULE = FileRule(
    id="cpp.repeated_condition",
    title="Condition asked twice in one chain",
    finds="`if (a) … else if (a)`: the second branch is never taken. One of the two was meant to be another.",
    why="A state of the robot that has a branch of its own is treated as another one.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy bugprone-branch-clone",),
    bad="void f(int a) { if (a == 1) g(); else if (a == 1) h(); }\n",
    good="void f(int a) { if (a == 1) g(); else if (a == 2) h(); }\n",
    syntax="cpp",
    kinds=("(if_statement alternative: (_ (if_statement))) @node",),
    found=found,
)
