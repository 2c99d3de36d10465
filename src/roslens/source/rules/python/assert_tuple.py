"""Rule ``python.assert_tuple``: an assertion that always holds."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``assert (condition, message)``."""
    first = next((child for child in node.children if child.is_named), None)
    if first is not None and first.type == "tuple" and any(child.is_named for child in first.children):
        message = "an assertion of a tuple always holds; expected `assert condition, message`"
        yield view.hit("python.assert_tuple", node, message)


RULE = FileRule(
    id="python.assert_tuple",
    title="Assertion that always holds",
    finds="`assert (condition, message)`: a tuple is true whatever is in it. Leave the parentheses out.",
    why="What was meant to stop the robot, or to fail the test, never does.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("assert_statement",),
    clauses=("pylint W0199", "ruff F631"),
    bad='assert (speed < 1.0, "too fast")',
    good='assert speed < 1.0, "too fast"',
    found=found,
)
