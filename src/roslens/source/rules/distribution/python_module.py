"""Rule ``distribution.python_module``: an import of a module that a distribution of ROS does not have any more."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.read_changes import Kind, changes_of
from roslens.source.rules.distribution.row_hit import row_message
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an import of a module of the tables, but where the program tries."""
    if above(node, "try_statement", "if_statement") is not None:
        return
    field = "module_name" if node.type == "import_from_statement" else "name"
    for one in node.children_by_field_name(field):
        written = view.text(one.child_by_field_name("name") or one)
        for change in changes_of(Kind.MODULE).get(written, ()):
            hit = view.hit("distribution.python_module", one, f"module {row_message(change, written)}")
            yield msgspec.structs.replace(hit, change=change.key)


RULE = FileRule(
    id="distribution.python_module",
    title="Module of Python that the distribution does not have",
    finds="An import of a module that a distribution of ROS does not have any more, by a dated table: `rclpy.handle` "
    "from Humble on. An import in `try` or `if` is left out. For which distributions a package is built, `distro` in "
    "roslens.toml or `--distro` says; otherwise files of continuous integration and containers do. What is gone in a "
    "later distribution where none is known is a note.",
    why="Python raises a ModuleNotFoundError when the program starts, in that distribution only.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("distribution",),
    bad="from rclpy.handle import Handle\n",
    good="from rclpy.node import Node\n",
    syntax="python",
    kinds=("import_from_statement", "import_statement"),
    found=found,
)
