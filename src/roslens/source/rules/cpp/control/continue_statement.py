"""Rule ``cpp.continue_statement``: a jump to the next turn."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each continue."""
    yield view.hit("cpp.continue_statement", node, "`continue`; expected an `if` around the rest of the body")


RULE = FileRule(
    id="cpp.continue_statement",
    title="`continue`",
    finds="A `continue` statement. Put the rest of the body into an `if`.",
    why="JSF AV forbids it: what a turn of the loop does should be read from top to bottom.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("jsf-av",),
    clauses=("jsf-av 190",),
    bad="void f(int a) { while (a) { if (--a == 3) continue; g(a); } }\n",
    good="void f(int a) { while (a) { if (--a != 3) g(a); } }\n",
    syntax="cpp",
    kinds=("continue_statement",),
    found=found,
)
