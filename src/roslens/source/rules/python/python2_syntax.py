"""Rule ``python.python2_syntax``: statements that Python 3 cannot read."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_WORD = re.compile(rb"\b(?:print|exec|except|raise)\b")


def found(_root: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first statement of Python 2, with how many there are."""
    first: tuple[Node, str] | None = None
    count = 0
    for match in _WORD.finditer(view.code):
        at = view.node_at(match.start(), match.end())
        statement = at.parent if at is not None and at.start_byte == match.start() else None
        what = _of_python_2(statement) if statement is not None else ""
        if statement is not None and what:
            count += 1
            first = first or (statement, what)
    if first is not None:
        more = f" (and {count - 1} more in this file)" if count > 1 else ""
        message = f"{first[1]} of Python 2{more}, which Python 3 cannot read; expected Python 3"
        yield view.hit("python.python2_syntax", first[0], message)


def has_statement_of_python2(view: FileView) -> bool:
    """Return whether a file has a statement that only Python 2 reads."""
    return next(found(view.root, view), None) is not None


def _of_python_2(statement: Node) -> str:
    if statement.type == "print_statement":
        return "print statement"
    if statement.type == "exec_statement":
        return "exec statement"
    if statement.type == "except_clause" and any(child.type == "," for child in statement.children):
        return "`except Type, name`"
    if statement.type == "raise_statement" and any(child.type == "expression_list" for child in statement.children):
        return "`raise Type, value`"
    return ""


RULE = FileRule(
    id="python.python2_syntax",
    title="Statement of Python 2",
    finds="`print x`, `exec x`, `except Type, name` and `raise Type, value`. The first of a file is reported, with "
    "their number; `2to3` rewrites them.",
    why="Python 3 ends with a SyntaxError before the first line runs; Noetic and all of ROS 2 have no other.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    whole=True,
    clauses=("pylint E1601",),
    bad='def report(x):\n    print "x is", x',
    good='def report(x):\n    print("x is", x)',
    found=found,
)
