"""Rule ``node.topic_name_python``: a name of a topic or service that ROS refuses, in Python."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.naming.names import topic_fault
from roslens.source.rules.rule import RCLPY, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a literal name that is refused where the endpoint is made."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if len(given) < 2 or given[1].type != "string" or view.text(given[1])[:1] not in "'\"":
        return
    fault = topic_fault(view.text(given[1])[1:-1], ros1=False)
    if fault:
        yield view.hit(
            "node.topic_name_python",
            given[1],
            f"name `{view.text(given[1])}` {fault}, which `{view.text(node)}` refuses with an exception; expected "
            "letters, "
            "digits, _ and single /",
        )


RULE = FileRule(
    id="node.topic_name_python",
    title="Name that ROS refuses (rclpy)",
    finds="A literal name of a topic or service that is no valid name: a dash or a space, `~name` without a slash, a "
    "part that "
    "begins with a digit. Rename it.",
    why="The call that makes the endpoint raises InvalidTopicNameException: the node ends when it gets there, which "
    "may be long "
    "after its start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2",),
    tags=("names", "endpoints"),
    bad="import rclpy\nself.pub = self.create_publisher(State, 'arm-state', 10)\n",
    good="import rclpy\nself.pub = self.create_publisher(State, 'arm_state', 10)\n",
    syntax="python",
    anchors=("create_publisher", "create_subscription", "create_service", "create_client"),
    mentions=RCLPY,
    spares_tests=True,
    found=found,
)
