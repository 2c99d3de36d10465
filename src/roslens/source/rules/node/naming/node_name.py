"""Rule ``node.node_name``: a name of a node that ROS refuses."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.naming.names import node_fault
from roslens.source.rules.rule import ROS_CPP, FileRule

_MADE = re.compile(r"^std::make_(shared|unique)<rclcpp(_lifecycle)?::(Lifecycle)?Node>$")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a literal name handed to the constructor of a node, or to ``ros::init``."""
    given = _arguments(node, view)
    if given is None or given.type != "string_literal":
        return
    fault = node_fault(view.text(given)[1:-1])
    if fault:
        yield view.hit(
            "node.node_name",
            given,
            f"name of a node `{view.text(given)}` {fault}, which ROS refuses with an exception; expected letters, "
            "digits and _",
        )


def _arguments(node: Node, view: FileView) -> Node | None:
    """Return the argument that is the name of a node, where a node or ROS begins."""
    if view.text(node) == "ros::init":
        call = call_at(node)
        given = arguments(call) if call is not None else ()
        return given[2] if len(given) > 2 else None
    around = node.parent
    while around is not None and around.type not in ("field_initializer", "call_expression", "compound_statement"):
        around = around.parent
    if around is None or around.type == "compound_statement":
        return None
    return _of_call(around, view) if around.type == "call_expression" else _of_initializer(around, view)


def _of_call(call: Node, view: FileView) -> Node | None:
    """Return the first argument where a node is made."""
    given = arguments(call) if _MADE.match(view.text(call.child_by_field_name("function"))) else ()
    return given[0] if given else None


def _of_initializer(initializer: Node, view: FileView) -> Node | None:
    """Return the first argument where a class begins the node that it is."""
    first = initializer.named_children[0]
    if view.text(first) not in ("Node", "rclcpp::Node", "LifecycleNode", "rclcpp_lifecycle::LifecycleNode"):
        return None
    lists = (one for one in initializer.named_children if one.type in ("argument_list", "initializer_list"))
    listed = next(lists, None)
    return next(iter(listed.named_children), None) if listed is not None else None


RULE = FileRule(
    id="node.node_name",
    title="Name of a node that ROS refuses",
    finds="A literal name of a node with a dash, a slash, a space or a digit at its beginning. Rename it. Where a "
    "launch file of ROS 1 starts a node of the package it is a note, as that names the node.",
    why="The constructor throws InvalidNodeNameError, `ros::init` InvalidNodeNameException: the program ends at its "
    "start.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("names",),
    bad='#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm-node") {}\n',
    good='#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm_node") {}\n',
    syntax="cpp",
    anchors=("Node", "LifecycleNode", "ros::init"),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
