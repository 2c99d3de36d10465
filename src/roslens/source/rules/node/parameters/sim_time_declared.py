"""Rule ``node.sim_time_declared``: a parameter that every node has already."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, function_around
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_ASKS = re.compile(r"!\s*[\w.>()-]*get_parameter(?:_or)?\s*\(\s*\"use_sim_time\"")


def _never_runs(call: Node, view: FileView) -> bool:
    """Return whether a call stands where the parameter was asked for and is not there, which it always is."""
    around = above(call, "if_statement", "function_definition")
    condition = around.child_by_field_name("condition") if around is not None else None
    return condition is not None and _ASKS.search(view.text(condition)) is not None


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a declaration of ``use_sim_time`` that does not ask first."""
    call, function = call_at(node), function_around(node)
    given = arguments(call) if call is not None else ()
    if call is None or not given or view.text(given[0]) != '"use_sim_time"':
        return
    start = function.start_byte if function is not None else 0
    before = view.code[start : call.start_byte]
    if _never_runs(call, view):
        return
    if b"has_parameter" not in before and b"try" not in before and b"if_not" not in before:
        yield view.hit(
            "node.sim_time_declared",
            call,
            f"`{view.text(call)}` throws: every node declares `use_sim_time` itself; expected `get_parameter`",
        )


RULE = FileRule(
    id="node.sim_time_declared",
    title="use_sim_time declared again",
    finds='`declare_parameter("use_sim_time", ...)`. Read it with `get_parameter`; it is there.',
    why="The node's time source declares it before any code of the node runs: a second declaration throws "
    "ParameterAlreadyDeclaredException, and the process ends at start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters", "simulation"),
    bad='#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm") { declare_parameter("use_sim_time", true); }\n',
    good='#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm") { get_parameter("use_sim_time", simulated_); }\n',
    syntax="cpp",
    anchors=("declare_parameter",),
    mentions=("use_sim_time",),
    found=found,
)
