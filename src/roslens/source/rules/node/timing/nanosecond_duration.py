"""Rule ``node.nanosecond_duration``: seconds where nanoseconds are taken."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import constructed, number_of, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_SHORTEST = 1000
"""Whoever means nanoseconds means more than a microsecond of them."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``rclcpp::Duration(n)`` of a small literal number."""
    name, given = whole_name(node), constructed(node) or ()
    value = number_of(given[0], view) if len(given) == 1 else None
    if view.text(name) == "rclcpp::Duration" and value is not None and 0 < abs(value) < _SHORTEST:
        literal = view.text(given[0])
        yield view.hit(
            "node.nanosecond_duration",
            given[0],
            f"`rclcpp::Duration({literal})` is {literal} nanoseconds; expected "
            f"`rclcpp::Duration::from_seconds({literal})`",
        )


RULE = FileRule(
    id="node.nanosecond_duration",
    title="Duration in nanoseconds that looks like seconds",
    finds="`rclcpp::Duration` of one small number, which is nanoseconds. Use `rclcpp::Duration::from_seconds`, or two "
    "arguments.",
    why="Ported from ROS 1, where the number is seconds: the timeout is over at once, the buffer keeps nothing. Newer "
    "distributions refuse to build it.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("time",),
    bad="#include <rclcpp/rclcpp.hpp>\nauto limit = rclcpp::Duration(5);\n",
    good="#include <rclcpp/rclcpp.hpp>\nauto limit = rclcpp::Duration::from_seconds(5);\n",
    syntax="cpp",
    anchors=("rclcpp::Duration",),
    mentions=RCLCPP,
    found=found,
)
