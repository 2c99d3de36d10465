"""Rule ``python.star_import``: names from everywhere."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_HARMLESS = frozenset({"expression_statement", "import_from_statement", "import_statement", "comment"})


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``from … import *`` in a file that does more than import."""
    statement = above(node, "import_from_statement")
    if statement is None or all(child.type in _HARMLESS for child in view.root.children):
        return
    module = view.text(statement.child_by_field_name("module_name"))
    yield view.hit("python.star_import", statement, f"from {module} import *: expected the names that are used")


RULE = FileRule(
    id="python.star_import",
    title="Import of all names",
    finds="`from … import *` in a file that does more than import. Name what is used.",
    why="Two packages of messages share names (Point, Image, Header): which one a node publishes depends on the "
    "order of imports, and no checker finds a misspelt name.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("wildcard_import",),
    clauses=("pylint W0401", "ruff F403"),
    bad="from geometry_msgs.msg import *\n\ndef stop():\n    return Twist()",
    good="from geometry_msgs.msg import Twist\n\ndef stop():\n    return Twist()",
    spares_tests=True,
    found=found,
)
