"""Rule ``cpp.goto``: a jump to a label."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``goto``."""
    label = view.text(node.child_by_field_name("label"))
    yield view.hit("cpp.goto", node, f"`goto {label}`; expected a loop, an early return or a function of its own")


RULE = FileRule(
    id="cpp.goto",
    title="Jump to a label",
    finds="A `goto` statement. Use a loop, an early return or a function of its own instead.",
    why="Jumps make it hard to see which locks are held and which motors are stopped when a function is left.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("misra-cpp-2008", "misra-cpp-2023", "hicpp", "jsf-av", "autosar-cpp14", "safety", "paper2016"),
    clauses=("jsf-av 189", "hicpp 6.3.1", "misra-cpp-2008 6-6-2", "misra-cpp-2023 9.6.1", "autosar-cpp14 A6-6-1"),
    bad="void stop() {\n  goto end;\nend:\n  return;\n}\n",
    good="void stop() {\n  return;\n}\n",
    syntax="cpp",
    kinds=("goto_statement",),
    found=found,
)
