"""Rule ``cpp.default_argument``: a parameter that may be left out."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such parameter."""
    yield view.hit("cpp.default_argument", node, f"`{view.short(node)}`; expected an overload")


RULE = FileRule(
    id="cpp.default_argument",
    title="Default argument",
    finds="A parameter with a default. Overload the function.",
    why="High Integrity C++ forbids it: in virtual functions the default of the base is taken.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "paper2016",
    ),
    clauses=(
        "hicpp 8.3.3",
        "paper2016 harosDefaultArguments",
    ),
    bad="void f(int a = 3);\n",
    good="void f();\nvoid f(int a);\n",
    syntax="cpp",
    kinds=("optional_parameter_declaration",),
    found=found,
)
