"""Rule ``cpp.identical_branches``: a decision whose two ways are the same."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_STRING = re.compile(rb'("(?:[^"\\\n]|\\.)*")')


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
    if not _begin_alike(then, other, view):
        return
    # The end of a chain may be written out although what is left does the same.
    if (node.parent is not None and node.parent.type == "else_clause") or _ends_a_chain(node):
        return
    if then.type == "compound_statement" and not then.named_child_count:
        return
    if _written(then, view) == _written(other, view) and not _is_one_of_several(node, view):
        what = "branches" if node.type == "if_statement" else "values"
        yield view.hit(
            "cpp.identical_branches",
            node,
            f"both {what} are `{view.short(then)}`; expected them to differ, or no condition",
        )


def _begin_alike(then: Node, other: Node, view: FileView) -> bool:
    """Return whether two branches begin and end with the same byte: all else takes time with each level around it."""
    ends = ((one.start_byte, one.end_byte - 1) for one in (then, other))
    first, second = ([view.content[at] for at in places] for places in ends)
    return first == second


def _ends_a_chain(node: Node) -> bool:
    """Return whether a choice of two values is what is left of another one: its last row may be written out."""
    inner, around = node, node.parent
    while around is not None and around.type == "parenthesized_expression":
        inner, around = around, around.parent
    if around is None or around.type != "conditional_expression":
        return False
    return around.child_by_field_name("alternative") == inner


def _is_one_of_several(node: Node, view: FileView) -> bool:
    """Return whether the statement above or below chooses a value by the same condition: one row of a table."""
    condition = node.child_by_field_name("condition")
    if node.type != "conditional_expression" or condition is None:
        return False
    statement = node
    while statement.parent is not None and statement.parent.type != "compound_statement":
        statement = statement.parent
    asked = re.compile(re.escape(view.text(condition)) + r"\s*\?")
    neighbours = (statement.prev_named_sibling, statement.next_named_sibling)
    return any(one is not None and asked.search(view.text(one)) is not None for one in neighbours)


def _written(node: Node, view: FileView) -> list[bytes]:
    """Return the words of a branch as the file has them: macros are taken out of what is parsed.

    Strings are kept as they are: they may differ in nothing but their spaces.
    """
    text = view.content[node.start_byte : node.end_byte]
    return [word for part in _STRING.split(text) for word in ([part] if part[:1] == b'"' else part.split())]


RULE = FileRule(
    id="cpp.identical_branches",
    title="Both branches are the same",
    finds="`if (a) { x } else { x }` and `a ? x : x`: the condition decides nothing. One branch was meant to be "
    "another, or the condition goes.",
    why="The fallback of a failed sensor or planner is the failed way itself.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
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
