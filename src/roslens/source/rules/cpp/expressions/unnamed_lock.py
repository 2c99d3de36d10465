"""Rule ``cpp.unnamed_lock``: a lock that has no name and so protects nothing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

LOCKS = ("lock_guard", "scoped_lock", "unique_lock", "shared_lock")
_MAKE = ("call_expression", "compound_literal_expression")
_TYPE = re.compile(rf"(?:std|boost|::|\w*[Mm]utex)[\w:]*::(?:{'|'.join(LOCKS)})\s*(?:<.*>)?$", re.DOTALL)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a statement that is only a lock of a mutex."""
    made = node
    while made.parent is not None and made.type not in _MAKE:
        made = made.parent
    statement = made.parent
    if statement is None or statement.type != "expression_statement":
        return
    kind = made.child_by_field_name("function") or made.child_by_field_name("type")
    given = made.child_by_field_name("arguments") or made.child_by_field_name("value")
    if kind is None or given is None or not given.named_child_count or _TYPE.fullmatch(view.text(kind)) is None:
        return
    # `T (x);` declares x, whatever x is outside.
    is_declared = given.type == "argument_list" and [one.type for one in given.named_children] == ["identifier"]
    text = view.text(made)
    problem = (
        f"declares a lock of the name `{view.text(given.named_children[0])}` that locks no mutex"
        if is_declared
        else "locks until the end of the statement only"
    )
    yield view.hit(
        "cpp.unnamed_lock",
        statement,
        f"`{text};` {problem}; expected a name: `{view.text(kind)} lock{view.text(given)};`",
    )


RULE = FileRule(
    id="cpp.unnamed_lock",
    title="Lock without a name",
    finds="A statement that is only `std::lock_guard<std::mutex>{mutex};`, `std::scoped_lock(mutex);`, "
    "`boost::mutex::scoped_lock(mutex);` or another lock of these libraries: the lock has no name. Give it one.",
    why="With braces, or of a member of an object, the lock is destroyed at once. In parentheses a single name is "
    "declared: the lock has the name of the mutex and locks none. What follows is not protected, and callbacks of two "
    "threads change it at the same time.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1", "safety"),
    tags=("concurrency",),
    bad="#include <mutex>\nvoid Arm::on_goal() {\n  std::scoped_lock(mutex_);\n  ++goals_;\n}\n",
    good="#include <mutex>\nvoid Arm::on_goal() {\n  std::scoped_lock lock(mutex_);\n  ++goals_;\n}\n",
    syntax="cpp",
    anchors=LOCKS,
    found=found,
)
