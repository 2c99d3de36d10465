"""Rule ``cpp.long_jump``: a jump out of functions."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call of one of these functions."""
    if free_call(node, view) is not None:
        yield view.hit(
            "cpp.long_jump",
            node,
            f"`{view.text(node)}` leaves functions without destructors; expected an exception or a result",
        )


RULE = FileRule(
    id="cpp.long_jump",
    title="`setjmp` and `longjmp`",
    finds="`setjmp` and `longjmp` leave functions without destroying what they hold. Use exceptions or results.",
    why="Locks stay taken and memory is lost: the next callback waits forever.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 17-0-5",
        "misra-cpp-2023 21.10.2",
        "autosar-cpp14 M17-0-5",
        "jsf-av 20",
        "clang-tidy cert-err52-cpp",
    ),
    bad="void f() { longjmp(state, 1); }\n",
    good="void f() { throw Error(1); }\n",
    syntax="cpp",
    anchors=(
        "setjmp",
        "longjmp",
        "sigsetjmp",
        "siglongjmp",
    ),
    in_c=False,
    found=found,
)
