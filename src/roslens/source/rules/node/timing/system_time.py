"""Rule ``node.system_time``: the computer's clock where the time of ROS is meant."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import body_of, call_at, function_around, statement_around, whole_name
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.timing.stamp_flow import reached
from roslens.source.rules.rule import ROS_CPP, FileRule

_FOR_PEOPLE = re.compile(
    rb"to_time_t|strftime|put_time|localtime|gmtime|ctime|seed|srand|mt19937|random|[fF]ile|path|name"
)

_STAMP = re.compile(r"(?<![a-z])stamp")
"""Of a message; a variable such as `start_timestamp` is for telling how long something takes."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look at the system's clock, but where it names files, seeds random numbers or is shown."""
    call = call_at(node) or _read_as_declaration(node)
    function = function_around(node)
    body = body_of(function) if function is not None else None
    if call is None or body is None or not view.text(call).endswith("now()"):
        return
    end = reached(call, view)
    if end is None and (
        call.type != "call_expression" or _FOR_PEOPLE.search(view.code[body.start_byte : body.end_byte])
    ):
        return
    is_stamp = end is not None or _STAMP.search(view.text(statement_around(call))) is not None
    carried = end.carried if end is not None else ""
    expected = "the node's `now()`" if is_stamp else "`std::chrono::steady_clock`, or the node's `now()`"
    yield view.hit(
        "node.system_time",
        call,
        f"`{view.text(call)}` jumps when the computer's clock is set and does not follow simulated time{carried}; "
        f"expected {expected}",
        certainty=None if is_stamp else Certainty.HEURISTIC,
    )


def _read_as_declaration(node: Node) -> Node | None:
    """Return what reads the clock in ``T t(std::chrono::system_clock::now());``, which could declare a function."""
    named = whole_name(node).parent
    return named if named is not None and named.type == "parameter_declaration" else None


RULE = FileRule(
    id="node.system_time",
    title="System clock in a node",
    finds="`std::chrono::system_clock::now()` in code of nodes, where it neither names files nor is shown to people. "
    "Use "
    "the node's clock for stamps, `steady_clock` to measure. The time is followed through variables, members and "
    "functions of the file; what goes into no stamp and meets no time of ROS is a note.",
    why="Robots set their clock when they get a network: a timeout measured over that moment is over at once or "
    "never. In "
    "simulation, stamps of it match nothing.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time", "simulation"),
    bad="#include <rclcpp/rclcpp.hpp>\nvoid Arm::tick() { start_ = std::chrono::system_clock::now(); }\n",
    good="#include <rclcpp/rclcpp.hpp>\nvoid Arm::tick() { start_ = std::chrono::steady_clock::now(); }\n",
    syntax="cpp",
    anchors=("system_clock::now",),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
