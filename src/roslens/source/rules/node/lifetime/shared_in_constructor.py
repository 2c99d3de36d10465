"""Rule ``node.shared_in_constructor``: a constructor that asks for the shared pointer that does not own it yet."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import call_at, function_around, is_handled
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield ``shared_from_this()`` of the object that is being made; a lambda may run later."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or function.type != "function_definition":
        return
    scope, _, last = function_name(function, view).rpartition("::")
    if scope and scope == last and view.text(call) in ("shared_from_this()", "this->shared_from_this()"):
        yield view.hit(
            "node.shared_in_constructor",
            call,
            f"`{view.text(call)}` in the constructor of `{last}` throws std::bad_weak_ptr; expected `*this`, the "
            "interfaces of the node, or a function called after it was made",
            certainty=Certainty.HEURISTIC if is_handled(call) else None,
        )


RULE = FileRule(
    id="node.shared_in_constructor",
    title="shared_from_this in a constructor",
    finds="`shared_from_this()` in a constructor. Hand over `*this` or the node's interfaces, or begin in a function "
    "that is called once the node was made. Behind a handler of exceptions it is a note.",
    why="No shared pointer owns the object before its constructor returns: it throws std::bad_weak_ptr, and the node "
    "ends "
    "before it began.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2",),
    tags=("lifetime",),
    bad='#include <rclcpp/rclcpp.hpp>\nArm::Arm() : Node("arm") { it_ = Transport(shared_from_this()); }\n',
    good="#include <rclcpp/rclcpp.hpp>\nvoid Arm::start() { it_ = Transport(shared_from_this()); }\n",
    syntax="cpp",
    anchors=("shared_from_this",),
    mentions=RCLCPP,
    found=found,
)
