"""Rule ``cpp.friend``: a function that sees everything."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each friend that is no operator."""
    text = view.text(node)
    if "operator" not in text:
        yield view.hit("cpp.friend", node, f"`{shortened(text, 60)}`; expected a function of the class")


RULE = FileRule(
    id="cpp.friend",
    title="`friend`",
    finds="A `friend` declaration. Give the class a function that does what the friend needs; operators are let be.",
    why="AUTOSAR forbids it: the private part of the class is not private.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("autosar-cpp14",),
    clauses=("autosar-cpp14 A11-3-1",),
    bad="class A { friend class B; };\n",
    good="class A { void share(B& b); };\n",
    syntax="cpp",
    kinds=("friend_declaration",),
    found=found,
)
