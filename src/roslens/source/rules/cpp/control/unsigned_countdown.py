"""Rule ``cpp.unsigned_countdown``: a loop that counts an unsigned number down past zero."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_UNSIGNED = re.compile(r"\b(unsigned|size_t|uint\d+_t|uint|size_type|uint_fast\d+_t)\b")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a loop whose condition is that an unsigned number is at least zero."""
    start, condition = node.child_by_field_name("initializer"), node.child_by_field_name("condition")
    if start is None or start.type != "declaration" or condition is None or condition.type != "binary_expression":
        return
    left, right = condition.child_by_field_name("left"), condition.child_by_field_name("right")
    kind = view.text(start.child_by_field_name("type"))
    declarator = start.child_by_field_name("declarator")
    name = view.text(declarator.child_by_field_name("declarator")) if declarator is not None else ""
    text, operator = view.text(condition), view.text(condition.child_by_field_name("operator"))
    if (
        _UNSIGNED.search(kind)
        and view.text(left) == name
        and operator == ">="
        and view.text(right) in ("0", "0u", "0U")
        and not _is_left(node, name, view)
    ):
        yield view.hit(
            "cpp.unsigned_countdown",
            condition,
            f"`{text}` is always true: `{name}` is {kind}; expected a signed type or `{name}-- > 0`",
        )


def _is_left(loop: Node, name: str, view: FileView) -> bool:
    """Return whether the body looks for zero itself, and leaves."""
    body = view.text(loop.child_by_field_name("body"))
    at_zero = rf"\b{re.escape(name)}\s*==\s*0\b|\b0\s*==\s*{re.escape(name)}\b|!\s*{re.escape(name)}\b"
    return re.search(at_zero, body) is not None and re.search(r"\b(?:break|return|goto)\b", body) is not None


RULE = FileRule(
    id="cpp.unsigned_countdown",
    title="Unsigned loop that never ends",
    finds="`for (unsigned i = n; i >= 0; --i)`: an unsigned number is never below zero. Count with a signed "
    "type, or test `i-- > 0`.",
    why="The loop never ends, or reads far outside of the array.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    bad="void f() { for (unsigned i = 9; i >= 0; --i) g(i); }\n",
    good="void f() { for (int i = 9; i >= 0; --i) g(i); }\n",
    syntax="cpp",
    kinds=("for_statement",),
    found=found,
)
