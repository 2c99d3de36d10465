"""Rule ``node.home_path``: a path that exists on one computer."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

PATH = re.compile(r"""^["']?(/home/\w[\w.-]*/|/Users/\w[\w.-]*/|[A-Z]:\\+Users\\+\w)""")
PLACEHOLDERS = frozenset(
    ("user", "username", "you", "your_username", "USER", "<user>", "foo", "bar", "me", "name", "xxx")
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a text that begins with a folder of somebody's home."""
    return of_string(node, view, "node.home_path", "a parameter, or `ament_index_cpp::get_package_share_directory`")


def of_string(node: Node, view: FileView, rule: str, expected: str) -> Iterator[Hit]:
    """Yield a text that begins with a folder of somebody's home, in any language."""
    text = view.text(node)
    match = PATH.match(text)
    if match is not None and match[1].strip("/").rpartition("/")[2] not in PLACEHOLDERS:
        yield view.hit(rule, node, f"path `{shortened(text, 80)}` is on one computer only; expected {expected}")


RULE = FileRule(
    id="node.home_path",
    title="Path in a user's home folder",
    finds="A text that begins with `/home/name/` or `/Users/name/`. Make it a parameter, or find files of packages by "
    "the "
    "package's share folder.",
    why="On the robot, and on the computer of the next colleague, there is no such folder: the node ends at start, or "
    "writes "
    "its log nowhere.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("portability",),
    bad='std::ifstream map("/home/anna/ws/map.yaml");\n',
    good='std::ifstream map(get_parameter("map").as_string());\n',
    syntax="cpp",
    quoted=("/home/", "/Users/"),
    spares_tests=True,
    found=found,
)
