"""Rule ``node.queue_size_zero``: a queue of length 0."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, call_at, constructed, number_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_MAKERS = frozenset(("create_publisher", "create_subscription"))
_ROS_1 = "roscpp takes it as without end"
_ROS_2 = "a history of no messages keeps nothing"


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a queue of length 0 where a publisher or subscription is made."""
    name = view.text(node)
    if name in ("rclcpp::QoS", "rclcpp::KeepLast", "KeepLast"):
        given = constructed(node)
        call = above(node, "call_expression")
        while call is not None and callee_name(call, view) not in _MAKERS:
            call = above(call, "call_expression")
        if call is not None and given and number_of(given[0], view) == 0:
            yield view.hit("node.queue_size_zero", given[0], f"`{name}(0)`: {_ROS_2}; expected 1 or more")
        return
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if len(given) < 2 or number_of(given[1], view) != 0:
        return
    is_ros2 = name.startswith("create_")
    if not is_ros2 and given[0].type not in ("string_literal", "identifier", "binary_expression", "call_expression"):
        return
    meaning = _ROS_2 if is_ros2 else _ROS_1
    # What is published now and then never piles up; what a subscription gets it does not decide.
    certainty = Certainty.HEURISTIC if name == "advertise" else None
    message = f"queue of length 0 in `{name}`: {meaning}; expected 1 or more"
    yield view.hit("node.queue_size_zero", given[1], message, certainty=certainty)


RULE = FileRule(
    id="node.queue_size_zero",
    title="Queue of length 0",
    finds="A publisher or subscription whose queue, history depth or `QoS` is 0. Name how many messages may wait: 1 "
    "where "
    "only the newest counts. "
    "Of a publisher of roscpp it is a note.",
    why="In ROS 1 it means without end: a slow subscriber works on ever older messages until the memory is gone. In "
    "ROS 2 "
    "it means none, which no middleware does as written.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("endpoints", "queues", "qos"),
    bad='#include <ros/ros.h>\nvoid Arm::start() { pub_ = nh_.advertise<State>("state", 0); }\n',
    good='#include <ros/ros.h>\nvoid Arm::start() { pub_ = nh_.advertise<State>("state", 1); }\n',
    syntax="cpp",
    anchors=("advertise", "subscribe", "create_publisher", "create_subscription", "rclcpp::QoS", "KeepLast"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
