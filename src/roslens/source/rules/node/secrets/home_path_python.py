"""Rule ``node.home_path_python``: a path that exists on one computer, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.secrets.home_path import of_string
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a text that begins with a folder of somebody's home, but no docstring."""
    around = node.parent if node.type != "string" else node
    if around is not None and around.parent is not None and around.parent.type == "expression_statement":
        return iter(())
    return of_string(node, view, "node.home_path_python", "a parameter, or `get_package_share_directory`")


RULE = FileRule(
    id="node.home_path_python",
    title="Path in a user's home folder (Python)",
    finds="A text that begins with `/home/name/` or `/Users/name/`, launch files included. Make it a parameter or "
    "argument, or "
    "find files of packages by the package's share folder.",
    why="On the robot, and on the computer of the next colleague, there is no such folder: the launch fails, or the "
    "node "
    "writes its log nowhere.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("portability",),
    bad="MAP = '/home/anna/ws/map.yaml'\n",
    good="MAP = os.path.join(get_package_share_directory('maps'), 'map.yaml')\n",
    syntax="python",
    quoted=("/home/", "/Users/"),
    spares_tests=True,
    found=found,
)
