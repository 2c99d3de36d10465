"""Rule ``node.shutdown_in_constructor``: a constructor that shuts ROS down and goes on."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import cast

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import call_at, function_around, is_discarded, statement_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_LEAVES = re.compile(r"(?:return|throw|(?:std::|::)?_?exit|(?:std::)?abort|(?:std::)?terminate)\b")
_LOGS = re.compile(r"(?:ROS_|RCLCPP_)\w+\s*\(|std::c(?:out|err)\b")
_TOLD = "constructors that shut down"
_PASSES = ("else_clause", "compound_statement", "if_statement", "case_statement")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the first shutdown in a constructor behind which it does something else than to leave."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or function.type != "function_definition" or not is_discarded(call):
        return
    scope, _, last = function_name(function, view).rpartition("::")
    if not scope or scope.rpartition("::")[2] != last:
        return
    after = _next(statement_around(call), function)
    while after is not None and _LOGS.match(view.text(after)):
        after = _next(after, function)
    if after is None or _LEAVES.match(view.text(after)):
        return
    told = cast("set[int]", view.kept.setdefault(_TOLD, set()))
    if function.start_byte in told:
        return
    told.add(function.start_byte)
    line = after.start_point[0] + 1
    yield view.hit(
        "node.shutdown_in_constructor",
        call,
        f"`{view.text(call)}` in the constructor of `{last}`, which goes on in line {line} with what is not valid; "
        "expected an exception, or `return`",
    )


def _next(statement: Node, function: Node) -> Node | None:
    """Return what runs behind a statement, also behind the blocks that it is the last of; None at the end."""
    one: Node | None = statement
    while one is not None and one != function:
        after = one.next_named_sibling
        while after is not None and after.type in ("comment", "else_clause"):
            after = after.next_named_sibling
        if after is not None and one.parent is not None and one.parent.type == "compound_statement":
            return after
        one = one.parent
        if one is not None and one.type not in _PASSES and one != function:
            return None
    return None


RULE = FileRule(
    id="node.shutdown_in_constructor",
    title="Constructor that shuts down and goes on",
    finds="`rclcpp::shutdown()` or `ros::shutdown()` in a constructor, with code behind it that runs nevertheless; "
    "once for a constructor. Throw an exception, which `main` or the container reports.",
    why="shutdown returns: the constructor goes on with an empty address or list, and ends the program with a "
    "violation of memory in place of the message.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="#include <rclcpp/rclcpp.hpp>\nArm::Arm() { if (host.empty()) { rclcpp::shutdown(); } connect(host); }\n",
    good="#include <rclcpp/rclcpp.hpp>\n"
    'Arm::Arm() { if (host.empty()) { throw std::invalid_argument("host"); } connect(host); }\n',
    syntax="cpp",
    anchors=("rclcpp::shutdown", "ros::shutdown"),
    mentions=ROS_CPP,
    found=found,
)
