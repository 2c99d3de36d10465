"""Rule ``cpp.identical_branches``: a decision whose two ways are the same."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a decision whose two branches are written alike, and are not empty."""
    then, other = node.child_by_field_name("consequence"), node.child_by_field_name("alternative")
    if then is None or other is None:
        return
    if other.type == "else_clause":
        inside = [one for one in other.named_children if one.type != "comment"]
        if len(inside) != 1:
            return
        other = inside[0]
    # The end of a chain may be written out although what is left does the same.
    if node.parent is not None and node.parent.type == "else_clause":
        return
    if then.type == "compound_statement" and not then.named_child_count:
        return
    if _written(then, view) == _written(other, view):
        what = "branches" if node.type == "if_statement" else "values"
        yield view.hit(
            "cpp.identical_branches",
            node,
            f"both {what} are `{view.text(then)[:60]}`; expected them to differ, or no condition",
        )


def _written(node: Node, view: FileView) -> list[bytes]:
    """Return the words of a branch as the file has them: macros are taken out of what is parsed."""
    return view.content[node.start_byte : node.end_byte].split()


RULE = FileRule(
    id="cpp.identical_branches",
    title="Both branches are the same",
    finds="`if (a) { x } else { x }` and `a ? x : x`: the condition decides nothing. One branch was meant to be "
    "another, or the condition goes.",
    why="The fallback of a failed sensor or planner is the failed way itself.",
    profiles=(
        "ros2",
        "ros1",
        "safety",
    ),
    clauses=("clang-tidy bugprone-branch-clone",),
    bad="int f(bool left, int a, int b) { return left ? a : a; }\n",
    good="int f(bool left, int a, int b) { return left ? a : b; }\n",
    syntax="cpp",
    kinds=("(if_statement alternative: (_)) @node", "conditional_expression"),
    found=found,
)
