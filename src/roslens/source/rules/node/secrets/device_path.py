"""Rule ``node.device_path``: a device that is another one tomorrow."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_DEVICE = re.compile(r"""^["']?(/dev/(?:tty(?:USB|ACM|S|AMA)|video|input/js|i2c-)\d+)["']?$""")
_PARAMETER = re.compile(r"param|Param|default|getenv|environ|argument|get<|add_")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the path of a numbered device that is no default of a parameter."""
    return of_string(node, view, "node.device_path", "call_expression")


def of_string(node: Node, view: FileView, rule: str, call_type: str) -> Iterator[Hit]:
    """Yield the path of a numbered device that is an argument, but no default of a parameter, in any language."""
    match = _DEVICE.match(view.text(node))
    call = above(node, call_type)
    listed = call.child_by_field_name("arguments") if call is not None else None
    if match is None or call is None or listed is None or node.start_byte < listed.start_byte:
        return
    if _PARAMETER.search(callee_name(call, view)):
        return
    yield view.hit(
        rule,
        node,
        f"device `{match[1]}` is fixed in the source; expected a parameter, with a name of /dev/serial/by-id as value",
    )


RULE = FileRule(
    id="node.device_path",
    title="Numbered device in the source",
    finds="`/dev/ttyUSB0`, `/dev/video1` and the like, in code of nodes, where it is no default of a parameter. Make "
    "it a "
    "parameter.",
    why="Numbers are given in the order of plugging: after the next start the motor controller is where the laser was.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("portability",),
    bad='#include <ros/ros.h>\nvoid f() { port.open("/dev/ttyUSB0"); }\n',
    good='#include <ros/ros.h>\nvoid f() { port.open(nh.param<std::string>("port", "/dev/ttyUSB0")); }\n',
    syntax="cpp",
    quoted=("/dev/tty", "/dev/video", "/dev/input/js", "/dev/i2c-"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
