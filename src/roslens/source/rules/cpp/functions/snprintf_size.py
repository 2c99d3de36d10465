"""Rule ``cpp.snprintf_size``: a size that is written twice."""

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
    """Yield each call whose size is a number other than 0."""
    call = free_call(node, view)
    arguments = arguments_of(call) if call is not None else []
    if len(arguments) > 1 and arguments[1].type == "number_literal" and view.text(arguments[1]) != "0":
        size, target = view.text(arguments[1]), view.text(arguments[0])
        yield view.hit(
            "cpp.snprintf_size",
            arguments[1],
            f"size `{size}` of `{shortened(target, 40)}`; expected `sizeof {shortened(target, 40)}`",
        )


RULE = FileRule(
    id="cpp.snprintf_size",
    title="Size of `snprintf` as a number",
    finds="A number as the size of `snprintf`. Write `sizeof buffer`.",
    why="The buffer is made smaller one day, and the number is not.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/printf",
        "paper2016 snprintf_args",
    ),
    bad='void f(int n) { char b[8]; snprintf(b, 8, "%d", n); }\n',
    good='void f(int n) { char b[8]; snprintf(b, sizeof b, "%d", n); }\n',
    syntax="cpp",
    anchors=("snprintf", "vsnprintf"),
    found=found,
)
