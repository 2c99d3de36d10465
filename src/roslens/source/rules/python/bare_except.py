"""Rule ``python.bare_except``: an except that catches everything, the end of the program too."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_SLEEPS = re.compile(r"[\w.]+\.sleep\([^()]*\)")
"""All that is tried: the end of the program ends the sleep, and the loop around it looks whether it goes on."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an ``except`` without a type that does not raise again."""
    if any(child.is_named and child.type not in ("block", "comment") for child in node.children):
        return
    if _SLEEPS.fullmatch(_tried(node, view)):
        return
    if next(below(node, "raise_statement"), None) is None and not _ends(node, view):
        message = "except without a type catches SystemExit, KeyboardInterrupt and misspelt names; expected a type"
        certainty = None if b"rospy" in view.code or b"rclpy" in view.code else Certainty.HEURISTIC
        yield view.hit("python.bare_except", node.children[0], message, certainty=certainty)


def _tried(node: Node, view: FileView) -> str:
    whole = node.parent
    return view.text(whole.child_by_field_name("body")) if whole is not None else ""


def _ends(node: Node, view: FileView) -> bool:
    text = view.text(node)
    return "exit(" in text or "traceback." in text or "exc_info" in text


RULE = FileRule(
    id="python.bare_except",
    title="Except that catches everything",
    finds="An `except:` without a type that neither raises again, ends the program nor prints the trace. Name the "
    "exceptions, or write `except Exception`. "
    "In a file without rospy and rclpy it is a note.",
    why="It also catches KeyboardInterrupt, SystemExit and the exception by which rospy and rclpy end a wait: the "
    "node cannot be stopped, and a misspelt name is never noticed.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("except_clause",),
    clauses=("pylint W0702", "ruff E722"),
    bad="import rospy\ntry:\n    pose = listener.lookup()\nexcept:\n    pose = None",
    good="import rospy\ntry:\n    pose = listener.lookup()\nexcept LookupError:\n    pose = None",
    spares_tests=True,
    found=found,
)
