"""Rule ``node.log_arguments_python``: arguments that the logger of rclpy does not take."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, keywords
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule

_FIELD = re.compile(r"%[-#0 +]*\d*(?:\.\d+)?[sdifgrxXeE]")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call of a node's logger with more than the message."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) < 2 or given[0].type == "list_splat":
        return
    if "get_logger()." in view.text(call.child_by_field_name("function")):
        yield view.hit(
            "node.log_arguments_python",
            call,
            f"`{view.short(call, 80)}`: rclpy's logger takes the message alone and raises TypeError up to ROS 2 Jazzy; "
            "expected an f-string",
            edits=_formatted(call, given, view),
        )


def _formatted(call: Node, given: Sequence[Node], view: FileView) -> tuple[Edit, ...]:
    """Return what hands the arguments to the format, where there is one for each."""
    text = view.text(given[0])
    listed = call.child_by_field_name("arguments")
    plain = given[0].type == "string" and text[:1] in ("'", '"')
    if not plain or listed is None or len(given) != listed.named_child_count or keywords(call, view):
        return ()
    wanted = len(_FIELD.findall(text.replace("%%", "")))
    if wanted != len(given) - 1 or any(one.type == "list_splat" for one in given):
        return ()
    comma = "," if wanted == 1 else ""
    start, end = given[1].start_byte, given[-1].end_byte
    return view.edits((given[0].end_byte, start, " % ("), (end, end, f"{comma})"))


RULE = FileRule(
    id="node.log_arguments_python",
    title="Arguments for the logger of rclpy",
    finds="`get_logger().info('%s', value)`. Make the whole text: `f'{value}'`, or `'%s' % value`.",
    why="The logger of rclpy is not that of `logging`: a second argument raises TypeError where the line is reached, "
    "most "
    "often in the handler of a fault.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("logging",),
    fix="Hands the arguments to the format by `%`, where it is a literal with a field for each.",
    bad="import rclpy\nself.get_logger().error('failed: %s', reason)\n",
    good="import rclpy\nself.get_logger().error(f'failed: {reason}')\n",
    syntax="python",
    anchors=("debug", "info", "warn", "warning", "error", "fatal"),
    mentions=RCLPY,
    found=found,
)
