"""Rule ``node.console_output``: a node that writes to its console without a logger."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ROS = (b"ros/", b"rclcpp/")
_STREAM = re.compile(rb"\bstd::c(?:out|err)\b")
_MAIN = re.compile(rb"\bint\s+main\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first use in a function of a stream of the console, in a file of a node without ``main``."""
    around = node.parent
    if around is not None and around.type in ("optional_parameter_declaration", "init_declarator", "argument_list"):
        return
    function = function_around(node)
    if function is not None and _STREAM.search(view.code, function.start_byte, node.start_byte):
        return
    if view.mentions(_ROS) and not _MAIN.search(view.code):
        yield view.hit(
            "node.console_output",
            node,
            f"`{view.text(node)}` in a node; expected RCLCPP_INFO, ROS_INFO or another macro of the logger",
        )


RULE = FileRule(
    id="node.console_output",
    title="Console output past the logger",
    finds="`std::cout` or `std::cerr` in a file that includes ROS and has no `main`. A program "
    "may talk to its console; elsewhere use the logging macros. Reported once a function.",
    why="What is not logged has no severity, no time and no node name, and is in no log file and on no /rosout: after "
    "a failure in the field it is gone.",
    consequence=Consequence.STYLE,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("logging",),
    bad='#include <rclcpp/rclcpp.hpp>\nvoid f() { std::cout << "stopped"; }\n',
    good='#include <rclcpp/rclcpp.hpp>\nvoid f() { RCLCPP_INFO(logger, "stopped"); }\n',
    syntax="cpp",
    anchors=("std::cout", "std::cerr"),
    found=found,
)
