"""Rule ``node.log_arguments_python``: arguments that the logger of rclpy does not take."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLPY, FileRule


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
            f"`{view.text(call)[:80]}`: rclpy's logger takes the message alone and raises TypeError up to ROS 2 Jazzy; "
            "expected an f-string",
        )


RULE = FileRule(
    id="node.log_arguments_python",
    title="Arguments for the logger of rclpy",
    finds="`get_logger().info('%s', value)`. Make the whole text: `f'{value}'`, or `'%s' % value`.",
    why="The logger of rclpy is not that of `logging`: a second argument raises TypeError where the line is reached, "
    "most "
    "often in the handler of a fault.",
    severity=Severity.ERROR,
    profiles=("ros2",),
    tags=("logging",),
    bad="import rclpy\nself.get_logger().error('failed: %s', reason)\n",
    good="import rclpy\nself.get_logger().error(f'failed: {reason}')\n",
    syntax="python",
    anchors=("debug", "info", "warn", "warning", "error", "fatal"),
    mentions=RCLPY,
    found=found,
)
