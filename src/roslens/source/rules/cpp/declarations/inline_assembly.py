"""Rule ``cpp.inline_assembly``: instructions of one processor."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each piece of assembly."""
    around = node.parent
    if node.type.startswith("gnu_asm") or (
        around is not None and (around.type.startswith("gnu_asm") or around.type == "call_expression")
    ):
        yield view.hit("cpp.inline_assembly", node, "inline assembly; expected an intrinsic, or a file of its own")


RULE = FileRule(
    id="cpp.inline_assembly",
    title="Inline assembly",
    finds="`asm` in C++. Use an intrinsic, or keep it in a file of its own.",
    why="The robot gets another processor.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
        "paper2016",
    ),
    clauses=(
        "hicpp 7.5.1",
        "misra-cpp-2023 10.4.1",
        "autosar-cpp14 A7-4-1",
        "paper2016 harosInlineAssembly",
        "clang-tidy hicpp-no-assembler",
    ),
    bad='void f() { asm("nop"); }\n',
    good="void f() { pause(); }\n",
    syntax="cpp",
    anchors=("asm", "__asm__", "__asm"),
    found=found,
)
