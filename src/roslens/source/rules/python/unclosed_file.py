"""Rule ``python.unclosed_file``: a file that is opened and never closed."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_READS = frozenset({"read", "readlines", "readline", "write", "writelines"})
_LOADS = re.compile(r"(?:json|yaml|pickle)\.(?:safe_)?(?:load|dump)$|(?:^|\.)reader$")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``open(…)`` whose file is used at once, so that nobody can close it."""
    call = node.parent
    if node.type != "identifier" or call is None or call.type != "call" or call.child_by_field_name("function") != node:
        return
    around = call.parent
    if around is None or (above(node, "with_statement", "with_item") is not None and around.type == "with_item"):
        return
    used = ""
    if around.type == "attribute" and view.text(around.child_by_field_name("attribute")) in _READS:
        used = view.text(around.child_by_field_name("attribute"))
    elif around.type == "argument_list" and around.parent is not None:
        function = view.text(around.parent.child_by_field_name("function"))
        used = function if _LOADS.search(function) else ""
    if used:
        message = f"the file is given to {used!r} and never closed; expected `with open(…) as file`"
        yield view.hit("python.unclosed_file", call, message)


RULE = FileRule(
    id="python.unclosed_file",
    title="File that is never closed",
    finds="`open(…).read()`, `yaml.load(open(…))` and the like. Open it in a `with` statement.",
    why="What was written may not be on the disk when the robot is switched off, and a node that opens one in a "
    "callback runs out of file descriptors.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    anchors=("open",),
    clauses=("pylint R1732", "ruff SIM115"),
    bad="calibration = yaml.safe_load(open(path))",
    good="with open(path) as file:\n    calibration = yaml.safe_load(file)",
    spares_tests=True,
    found=found,
)
