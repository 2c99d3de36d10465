"""Rule ``cpp.invalid_increment``: a pointer that moves where a count was meant to."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LINE = re.compile(rb"(\*)[ \t]*\w+(?:\+\+|--)[ \t]*;")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each statement that only moves a pointer and throws away what it points at."""
    for match, node in places(_LINE, view, 1):
        statement = node.parent if node.type != "pointer_expression" else node
        if statement is not None and statement.parent is not None and statement.parent.type == "expression_statement":
            text = match[0].decode("utf-8", "replace").strip(" \t;")
            yield view.hit(
                "cpp.invalid_increment",
                statement,
                f"`{text}` moves the pointer only; expected `({text[:-2]}){text[-2:]}`",
            )


RULE = FileRule(
    id="cpp.invalid_increment",
    title="Pointer moved instead of its value",
    finds="`*count++;` as a statement moves the pointer and leaves the value. Write `(*count)++`.",
    why="The counter never counts, and the pointer leaves its object.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/invalid_increment",
        "paper2016 invalid_increment",
    ),
    bad="void f(int* count) {\n  *count++;\n}\n",
    good="void f(int* count) {\n  (*count)++;\n}\n",
    syntax="cpp",
    whole=True,
    found=found,
)
