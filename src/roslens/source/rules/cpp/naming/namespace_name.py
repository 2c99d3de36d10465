"""Rule ``cpp.namespace_name``: a namespace that is not named like one."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each namespace with a capital letter."""
    named = node.child_by_field_name("name")
    name = view.text(named)
    if named is not None and name != name.lower():
        yield view.hit("cpp.namespace_name", named, f"namespace `{name}`; expected small letters and underscores")


RULE = FileRule(
    id="cpp.namespace_name",
    title="Name of a namespace",
    finds="A namespace whose name is not `under_scored`.",
    why="It is the name of the package, which is written so.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
    ),
    clauses=("clang-tidy readability-identifier-naming",),
    bad="namespace MyRobot {}\n",
    good="namespace my_robot {}\n",
    syntax="cpp",
    kinds=("namespace_definition",),
    found=found,
)
