"""Rule ``python.silent_except``: whatever goes wrong, nobody hears of it."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_BROAD = frozenset({"Exception", "BaseException", "StandardError"})


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield an ``except Exception`` whose body is ``pass``."""
    named = [child for child in node.children if child.is_named and child.type != "comment"]
    body = named[-1] if named and named[-1].type == "block" else None
    if body is None or len(named) != 2 or [one.type for one in body.children if one.is_named] != ["pass_statement"]:
        return
    caught = named[0].children[0] if named[0].type == "as_pattern" else named[0]
    if view.text(caught) in _BROAD and b"#" not in view.content[node.start_byte : node.end_byte]:
        message = f"except {view.text(caught)} with nothing but pass; expected a log message, or the type that is meant"
        yield view.hit("python.silent_except", node, message)


RULE = FileRule(
    id="python.silent_except",
    title="Exception that is ignored silently",
    finds="`except Exception: pass` (or `BaseException`) without a comment that says why. Log it, or catch the "
    "type that is meant.",
    why="A sensor that stopped, a parameter of the wrong type, a misspelt attribute: the robot goes on with old "
    "values and no log tells.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("except_clause",),
    clauses=("pylint W0703", "ruff S110", "bandit B110"),
    bad="try:\n    self.drive(twist)\nexcept Exception:\n    pass",
    good='try:\n    self.drive(twist)\nexcept Exception as error:\n    self.get_logger().error(f"cannot drive: '
    '{error}")',
    spares_tests=True,
    found=found,
)
