"""Rule ``node.topic_name``: a name of a topic or service that ROS refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, template_argument
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.naming.names import topic_fault
from roslens.source.rules.rule import FIRMWARE, ROS_CPP, FileRule

_OF_OTHERS = re.compile(r"[+#]|://")
"""In names of MQTT, and in addresses: whatever has a method of that name, nobody writes so for ROS."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a literal name that is refused where the endpoint is made."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) < 2 or given[0].type != "string_literal" or view.mentions(FIRMWARE):
        return
    name, is_ros1 = view.text(given[0])[1:-1], not view.text(node).startswith("create_")
    if _OF_OTHERS.search(name) or (not is_ros1 and not template_argument(call, view)):
        return
    fault = topic_fault(name, ros1=is_ros1)
    if fault:
        yield view.hit(
            "node.topic_name",
            given[0],
            f"name `{view.text(given[0])}` {fault}, which `{view.text(node)}` refuses with an exception; expected "
            "letters, "
            "digits, _ and single /",
        )


RULE = FileRule(
    id="node.topic_name",
    title="Name that ROS refuses",
    finds="A literal name of a topic or service that is no valid name: a dash or a space; in ROS 2 `~name` "
    "without a slash and a part that begins with a digit; in ROS 1, which looks at the first character alone, a name "
    "that begins with one (`/2d_map` is fine there). Rename it.",
    why="The call that makes the endpoint throws InvalidTopicNameError (ROS 2) or InvalidNameException (ROS 1): the "
    "node ends "
    "when it gets there, which may be long after its start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("names", "endpoints"),
    bad='#include <rclcpp/rclcpp.hpp>\nvoid Arm::start() { pub_ = create_publisher<State>("arm-state", 10); }\n',
    good='#include <rclcpp/rclcpp.hpp>\nvoid Arm::start() { pub_ = create_publisher<State>("arm_state", 10); }\n',
    syntax="cpp",
    anchors=(
        *("create_publisher", "create_subscription", "create_service", "create_client", "advertise", "subscribe"),
        *("advertiseService", "serviceClient"),
    ),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
