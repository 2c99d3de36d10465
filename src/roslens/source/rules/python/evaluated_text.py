"""Rule ``python.evaluated_text``: text becomes a program."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``eval`` and ``exec`` of anything but a plain text."""
    call = node.parent
    if node.type != "identifier" or call is None or call.type != "call" or call.child_by_field_name("function") != node:
        return
    arguments = call.child_by_field_name("arguments")
    given = [child for child in arguments.children if child.is_named] if arguments is not None else []
    if given and not (given[0].type == "string" and len(given[0].children) <= 3):
        name = view.text(node)
        message = f"{name}({view.short(given[0])}) runs a text as a program; expected ast.literal_eval, or a table"
        yield view.hit("python.evaluated_text", call, message)


RULE = FileRule(
    id="python.evaluated_text",
    title="Text that is run as a program",
    finds="`eval` and `exec` of anything but a plain text. Use `ast.literal_eval`, `getattr`, or a table of what "
    "is allowed.",
    why="Where the text comes from a parameter, a message or a file, whoever writes that controls the robot; and a "
    "typing mistake in a YAML file becomes a failure inside a node.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    anchors=("eval", "exec"),
    clauses=("bandit B307", "ruff S307", "pylint W0123"),
    bad='limits = eval(rospy.get_param("~limits"))',
    good='limits = ast.literal_eval(rospy.get_param("~limits"))',
    spares_tests=True,
    found=found,
)
