"""Rule ``cpp.do_loop``: a loop that asks at its end."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each do loop."""
    if view.text(node.child_by_field_name("condition")) not in ("(0)", "(false)"):
        yield view.hit("cpp.do_loop", node, "`do` loop; expected `while` or `for`")


RULE = FileRule(
    id="cpp.do_loop",
    title="`do` loop",
    finds="A `do … while` loop. Use `while` or `for`; the form `do { … } while (false)` of macros is let be.",
    why="AUTOSAR advises against it: the body runs before the condition was ever true.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("autosar-cpp14",),
    clauses=(
        "autosar-cpp14 A6-5-3",
        "clang-tidy cppcoreguidelines-avoid-do-while",
    ),
    bad="void f(int a) { do { --a; } while (a > 0); }\n",
    good="void f(int a) { while (a > 0) { --a; } }\n",
    syntax="cpp",
    kinds=("do_statement",),
    found=found,
)
