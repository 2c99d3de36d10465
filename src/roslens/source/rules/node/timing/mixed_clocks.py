"""Rule ``node.mixed_clocks``: times of two clocks, compared or subtracted."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import constructed, function_around, number_of, whole_name
from roslens.source.rules.cpp_flow.clock_of import clock_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_OPERATORS = frozenset(("-", "<", ">", "<=", ">=", "==", "!="))
_RAW = re.compile(r"stamp$")
_ROS_TIME = re.compile(
    r"^(?:this->)?(?:\w*node\w*(?:\(\))?(?:->|\.))?(?:get_clock\(\)->)?now\(\)$|^rclcpp::Time\(.*stamp\)$"
)
"""Of the clock of a node; any other object that is asked may be a clock of the system."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a time of the system's clock beside one of the node's."""
    if node.parent is None:
        yield from _of_two_clocks(view)
        return
    yield from _of_member(node, view)
    given = constructed(node)
    made = whole_name(node).parent
    around = made.parent if made is not None else None
    if given is None or made is None or around is None or around.type != "binary_expression":
        return
    if any(number_of(one, view) is None for one in given):
        return
    operator = view.text(around.child_by_field_name("operator"))
    left, right = around.child_by_field_name("left"), around.child_by_field_name("right")
    other = view.text(right if left == made else left)
    if operator not in _OPERATORS or (other.startswith(view.text(node)) and not _ROS_TIME.search(other)):
        return
    if _RAW.search(other) and left != made:
        return
    certain = _ROS_TIME.search(other) is not None
    yield view.hit(
        "node.mixed_clocks",
        around,
        f"`{view.text(around)}`: `{view.text(made)}` is of the system's clock, and "
        + ("the other side" if certain else f"`{other}`, where it comes of a message or the node's clock,")
        + f" of ROS time, so `{operator}` throws; expected `rclcpp::Time(0, 0, RCL_ROS_TIME)` or `nanoseconds() == 0`",
        certainty=None if certain else Certainty.HEURISTIC,
    )


def _of_two_clocks(view: FileView) -> Iterator[Hit]:
    """Yield where times of two clocks meet that the file makes and keeps in variables."""
    for one in view.nodes("binary_expression"):
        sign = one.children[1].type if one.child_count > 1 else ""
        if sign not in _OPERATORS:
            continue
        left, right = one.child_by_field_name("left"), one.child_by_field_name("right")
        of_left = clock_of(left, view)
        of_right = clock_of(right, view) if of_left else ""
        is_made_here = _is_literal(left, view) or _is_literal(right, view)
        if of_right and of_left != of_right and not is_made_here:
            yield view.hit(
                "node.mixed_clocks",
                one,
                f"`{view.short(one)}`: the left side is of {of_left}, the right one of {of_right}, so `{sign}` throws; "
                "expected times of one clock",
                certainty=Certainty.LIKELY,
            )


def _is_literal(side: Node | None, view: FileView) -> bool:
    """Return whether a side is a time that is made on the spot, which is asked about by its name."""
    return view.text(side).startswith("rclcpp::Time")


_BRANCHES = ("if_statement", "conditional_expression", "switch_statement", "while_statement")


def _of_member(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield where a member without a value, which is of the system's clock, meets the node's clock before it is set."""
    field = whole_name(node).parent
    if field is None or field.type != "field_declaration" or field.child_by_field_name("default_value") is not None:
        return
    declared = [view.text(one) for one in field.children_by_field_name("declarator")]
    if len(declared) != 1 or not declared[0].isidentifier():
        return
    name = declared[0]
    member = rf"(?:[\w\]]+(?:\.|->))*{name}\b(?![\w(.\[]|->)"
    now = r"(?:this->)?(?:get_clock\(\)->)?\bnow\(\)"
    meets = re.search(rf"{now}\s*(?:-|[<>]=?|==|!=)\s*{member}|{member}\s*(?:[<>]=?|==|!=)\s*{now}".encode(), view.code)
    if meets is None or re.search(rf"\b{name}\s*[({{]".encode(), view.code):
        return
    place = view.node_at(meets.start(), meets.end())
    function = function_around(place) if place is not None else None
    if place is None or function is None or _may_be_skipped(place, function, view):
        return
    first = re.search(rf"\b{name}\s*=[^=]".encode(), view.code)
    if first is None or meets.end() < first.start() < function.end_byte:
        yield view.hit(
            "node.mixed_clocks",
            place,
            f"`{view.text(place)}`: `{name}` has no value yet and is of the system's clock, the other side of "
            f"ROS time, so the first call throws; expected `{name}{{0, 0, RCL_ROS_TIME}}` where it is declared",
            certainty=Certainty.LIKELY,
        )


def _may_be_skipped(place: Node, function: Node, view: FileView) -> bool:
    """Return whether something decides before a place is reached: a branch around it, or a return before it."""
    inner: Node = place
    while (around := inner.parent) is not None and around != function:
        if around.type in _BRANCHES and around.child_by_field_name("condition") != inner:
            return True
        if around.type == "binary_expression" and view.text(around.child_by_field_name("operator")) in ("&&", "||"):
            return True
        inner = around
    return re.search(rb"\b(?:return|throw)\b", view.code[function.start_byte : place.start_byte]) is not None


RULE = FileRule(
    id="node.mixed_clocks",
    title="Times of different clocks compared",
    finds="`rclcpp::Time()` or `rclcpp::Time(0)` compared with, or subtracted from, a time of the node's clock; and "
    "likewise a member that is declared without a value and not set before; and times of two clocks that a file makes, "
    "such as `rclcpp::Clock(RCL_STEADY_TIME)`, also where variables keep them. Name the clock: "
    "`rclcpp::Time(0, 0, RCL_ROS_TIME)`.",
    why="A time without a clock type is of the system's clock, those of nodes and messages are of ROS time, and rclcpp "
    "throws «can't compare times with different time sources»: the process ends.",
    consequence=Consequence.WRONG,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("time",),
    bad="#include <rclcpp/rclcpp.hpp>\nbool Arm::is_new() { return now() > rclcpp::Time(0); }\n",
    good="#include <rclcpp/rclcpp.hpp>\nbool Arm::is_new() { return now() > rclcpp::Time(0, 0, RCL_ROS_TIME); }\n",
    syntax="cpp",
    anchors=("rclcpp::Time",),
    whole=True,
    words=("Clock",),
    gathers=("binary_expression",),
    mentions=RCLCPP,
    found=found,
)
