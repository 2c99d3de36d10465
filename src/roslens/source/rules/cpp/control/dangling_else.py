"""Rule ``cpp.dangling_else``: an `else` that belongs to another `if` than it seems."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an ``if`` with ``else`` that is the whole body of another ``if``."""
    body = node.child_by_field_name("consequence")
    if body is None or body.type != "if_statement":
        return
    if body.child_by_field_name("alternative") is not None and node.child_by_field_name("alternative") is None:
        yield view.hit(
            "cpp.dangling_else",
            body,
            "this `if` has an `else` and is the body of another `if`; expected braces around it",
        )


RULE = FileRule(
    id="cpp.dangling_else",
    title="`else` behind two `if`s",
    finds="`if (a) if (b) x; else y;` without braces: the `else` belongs to the inner `if`. Add braces.",
    why="The branch that was meant for the outer condition runs when the inner one fails, and not at all when "
    "the outer does.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/braces",
        "paper2016 if_else_indentation",
        "clang-tidy clang-diagnostic-dangling-else",
    ),
    bad="void f(bool a, bool b) { if (a) if (b) g(); else h(); }\n",
    good="void f(bool a, bool b) { if (a) { if (b) g(); else h(); } }\n",
    syntax="cpp",
    kinds=("(if_statement consequence: (if_statement)) @node",),
    found=found,
)
