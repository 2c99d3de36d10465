"""Rule ``cpp.nested_assignment``: an assignment inside of an expression."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NEAR = 80
_BEFORE_STATEMENTS = (b";", b"{", b"}")
_USES = (
    *("assignment_expression", "binary_expression", "argument_list", "init_declarator", "return_statement"),
    "condition_clause",
)


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each assignment whose result is used."""
    code = view.code
    for node in nodes:
        # To see that it is a statement, as most are, no node is needed.
        start = node.start_byte
        if code[max(start - _NEAR, 0) : start].rstrip()[-1:] not in _BEFORE_STATEMENTS:
            yield from _found(node, view)


def _found(node: Node, view: FileView) -> Iterator[Hit]:
    around = node.parent
    while around is not None and around.type == "parenthesized_expression":
        around = around.parent
    if around is None or around.type not in _USES:
        return
    if around.type == "argument_list" and (around.parent is None or "EXPECT" in view.text(around.parent)[:12]):
        return
    yield view.hit(
        "cpp.nested_assignment",
        node,
        f"`{view.short(node)}` inside of an expression; expected a statement of its own",
    )


RULE = FileRule(
    id="cpp.nested_assignment",
    title="Assignment inside of an expression",
    finds="`a = b = c`, or an assignment as an operand or argument. Write a statement of its own.",
    why="It reads like a comparison.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "paper2016",
    ),
    clauses=(
        "misra-cpp-2008 6-2-1",
        "misra-cpp-2023 8.18.2",
        "autosar-cpp14 M6-2-1",
        "jsf-av 160",
        "paper2016 harosAssignAssignment",
    ),
    bad="void f(int a, int b) { a = b = 3; }\n",
    good="void f(int a, int b) { b = 3; a = b; }\n",
    syntax="cpp",
    kinds=("assignment_expression",),
    found_among=found_among,
)
