"""Rule ``python.wall_time_duration``: a duration by the clock on the wall."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a difference of which one side is ``time.time()``."""
    operator = node.child_by_field_name("operator")
    if operator is None or operator.type != "-":
        return
    sides = (node.child_by_field_name("left"), node.child_by_field_name("right"))
    if any(side is not None and side.type == "call" and view.text(side) == "time.time()" for side in sides):
        what = view.short(node)
        message = f"{what!r} is a duration by a clock that jumps; expected time.monotonic() or ROS time"
        yield view.hit("python.wall_time_duration", node, message)


RULE = FileRule(
    id="python.wall_time_duration",
    title="Duration by the clock on the wall",
    finds="A difference of which one side is `time.time()`. Use `time.monotonic()`, or the time of ROS where "
    "simulation shall count.",
    why="A robot without a battery for its clock starts in 1970 and jumps when it gets network: the timeout never "
    "comes, or at once.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=(),
    syntax="python",
    kinds=("binary_operator",),
    clauses=(),
    bad="if time.time() - started > 5.0:\n    stop()",
    good="if time.monotonic() - started > 5.0:\n    stop()",
    spares_tests=True,
    found=found,
)
