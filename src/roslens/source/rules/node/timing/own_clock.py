"""Rule ``node.own_clock``: a clock that no node drives."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import constructed, function_around, whole_name
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.timing.stamp_flow import Reached, reached
from roslens.source.rules.rule import RCLCPP, FileRule

_STAMP = re.compile(r"stamp|header|lookup_?transform|can_?transform|ransform\(", re.IGNORECASE)
"""Where a time of the computer does harm: what others compare with theirs."""


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the present time of a clock that was made just for it."""
    made = whole_name(node).parent
    read = _read(node, view)
    call = read.parent if read is not None else None
    if made is None or read is None or call is None:
        return
    end = reached(call, view)
    if end is None and _is_measured(call):
        return
    is_initial = _is_initial(call, view)
    if end is not None and end.is_stamp and is_initial:
        end = None
    is_certain = end is not None or (_is_stamp(call, view) and not is_initial)
    what = f"`{view.text(read)}()` reads the computer's clock, whatever `use_sim_time` says{_led_to(end, made, view)}"
    certainty = None if is_certain else Certainty.HEURISTIC
    yield view.hit("node.own_clock", read, f"{what}; expected the node's `now()`", certainty=certainty)


def _read(node: Node, view: FileView) -> Node | None:
    """Return ``rclcpp::Clock().now`` where a clock that follows no simulated time is made and read at once."""
    made = whole_name(node).parent
    around = made.parent if made is not None else None
    if constructed(node) is None or around is None or around.type != "field_expression":
        return None
    is_read = view.text(around.child_by_field_name("field")) == "now" and "STEADY" not in view.text(made)
    return around if is_read else None


def _led_to(end: Reached | None, made: Node, view: FileView) -> str:
    """Return what to add to a message on where the time leads."""
    if end is None:
        return ""
    is_of_system = "ROS" not in view.text(made)
    return f"{end.carried}; times of two clocks throw" if not end.is_stamp and is_of_system else end.carried


def _is_measured(call: Node) -> bool:
    """Return whether the time is only compared with another one, to limit or measure a computation."""
    return call.parent is not None and call.parent.type == "binary_expression"


def _is_initial(call: Node, view: FileView) -> bool:
    """Return whether it is the first value of a member, which something better replaces."""
    if above(call, "field_declaration", "field_initializer") is not None and above(call, "compound_statement") is None:
        return True
    function = function_around(call)
    if function is None or function.type != "function_definition":
        return False
    scope, _, last = function_name(function, view).rpartition("::")
    assigned = above(call, "assignment_expression", "compound_statement")
    return bool(scope) and scope == last and assigned is not None and assigned.type == "assignment_expression"


def _is_stamp(call: Node, view: FileView) -> bool:
    """Return whether the time goes into a stamp, or is the default of a parameter that is one of ROS."""
    if above(call, "optional_parameter_declaration") is not None:
        return True
    statement = above(call, "expression_statement", "declaration", "return_statement", "field_declaration")
    return statement is not None and _STAMP.search(view.text(statement)) is not None


RULE = FileRule(
    id="node.own_clock",
    title="Clock that belongs to no node",
    finds="`rclcpp::Clock().now()`: the time of a clock that was made on the spot. Use `now()` or `get_clock()` of "
    "the node. The time is followed through variables, members and functions of the file. What goes into no stamp or "
    "look-up and meets no time of ROS is a note, and so is the first value of a member; differences of times of one "
    "clock are correct.",
    why="Only a node's clock follows /clock: in simulation and in a played bag the stamps are years off, and "
    "transforms of "
    "them do not exist. With RCL_ROS_TIME it is the same, for nothing is attached.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("time", "simulation"),
    bad="#include <rclcpp/rclcpp.hpp>\nvoid Arm::tick() { msg_.header.stamp = rclcpp::Clock().now(); }\n",
    good="#include <rclcpp/rclcpp.hpp>\nvoid Arm::tick() { msg_.header.stamp = now(); }\n",
    syntax="cpp",
    anchors=("rclcpp::Clock",),
    mentions=RCLCPP,
    spares_tests=True,
    found=found,
)
