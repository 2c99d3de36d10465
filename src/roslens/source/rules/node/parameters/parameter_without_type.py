"""Rule ``node.parameter_without_type``: a parameter that is declared with its name alone."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, receiver, template_argument
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_NODE = re.compile(r"(?i)^this$|node|^get_\w*parameters\w*\(\)$|shared_from_this")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a declaration without value, type and template argument."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or len(given) != 1 or given[0].type != "string_literal" or template_argument(call, view):
        return
    of = view.text(receiver(call))
    if of and not _NODE.search(of):
        # Another object than a node may keep its own parameters.
        return
    if re.search(rb"\b(?:void|auto|T|\w+_t|bool|int|double)\s+(?:\w+::)*declare_parameter\s*\(", view.code):
        return
    yield view.hit(
        "node.parameter_without_type",
        call,
        f"`{view.text(call)}` names neither a value nor a type: since Galactic it throws where no value is given at "
        "start; "
        "expected `declare_parameter<T>(name)` or a default",
    )


RULE = FileRule(
    id="node.parameter_without_type",
    title="Parameter declared without a type",
    finds="`declare_parameter(name)` without a default value or a type. Give a default, or "
    "`declare_parameter<double>(name)`.",
    why="Parameters have one type for good since ROS 2 Galactic, and the call with a name alone was deprecated there "
    "and "
    "removed: it does not build on newer distributions, and on older ones a launch file may set anything.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters", "deprecated"),
    bad='#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm") { declare_parameter("limit"); }\n',
    good='#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm") { declare_parameter("limit", 0.5); }\n',
    syntax="cpp",
    anchors=("declare_parameter",),
    mentions=RCLCPP,
    found=found,
)
