"""Rule ``cpp.memset_order``: memory that is not cleared, as its size is 0."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.cpp_statement import arguments_of, free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each call whose length is 0."""
    call = free_call(node, view)
    arguments = arguments_of(call) if call is not None else []
    if call is not None and len(arguments) == 3 and view.text(arguments[2]) == "0":
        text = view.text(arguments[1])
        yield view.hit(
            "cpp.memset_order",
            call,
            f"`memset` of length 0; expected `memset({view.short(arguments[0], 40)}, 0, {shortened(text, 40)})`",
        )


RULE = FileRule(
    id="cpp.memset_order",
    title="`memset` with a length of 0",
    finds="`memset(p, n, 0)` sets nothing: value and length are the wrong way round. Write `memset(p, 0, n)`.",
    why="A message to a motor controller goes out with what was in memory.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "safety",
    ),
    clauses=(
        "cpplint runtime/memset",
        "clang-tidy bugprone-suspicious-memset-usage",
    ),
    bad="void f(char* p) { memset(p, 10, 0); }\n",
    good="void f(char* p) { memset(p, 0, 10); }\n",
    syntax="cpp",
    anchors=("memset",),
    found=found,
)
