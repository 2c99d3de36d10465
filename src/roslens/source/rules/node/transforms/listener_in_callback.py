"""Rule ``node.listener_in_callback``: a transform listener or broadcaster that lives as long as a callback."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, function_name, spoken
from roslens.source.rules.calls import function_around, whole_name
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a local listener or broadcaster in a callback, and a local listener in a constructor."""
    name = whole_name(node)
    declaration, function = name.parent, function_around(node)
    if declaration is None or function is None or declaration.type != "declaration":
        return
    declarator = declaration.child_by_field_name("declarator")
    if declarator is None or declarator.type not in ("identifier", "init_declarator", "function_declarator"):
        return
    if "static" in view.text(declaration).split() or "*" in view.text(declarator).partition("=")[0]:
        return
    kind = view.text(node).rpartition("::")[2]
    does = "it hears nothing before it is asked" if kind.endswith("Listener") else "what it sends at once is lost"
    callback = callback_around(declaration, view)
    if callback is None or _is_asked_once(declaration, function, kind, view):
        return
    if function.type == "function_definition":
        scope, _, last = function_name(function, view).rpartition("::")
        if kind.endswith("Listener") and scope and scope == last:
            yield view.hit(
                "node.listener_in_callback",
                declaration,
                f"`{view.text(declaration)}` ends with the constructor of `{last}`: nothing fills its buffer "
                "afterwards; "
                "expected a member",
                certainty=Certainty.PROVEN,
            )
            return
    yield view.hit(
        "node.listener_in_callback",
        declaration,
        f"`{view.text(declaration)}` in {spoken(callback)} is made anew each time: {does}; expected a member",
        callback=callback,
        certainty=Certainty.HEURISTIC,
    )


def _is_asked_once(declaration: Node, function: Node, kind: str, view: FileView) -> bool:
    """Return whether a listener is waited for where it is made, in a constructor or a branch: it is needed no more."""
    after = view.code[declaration.end_byte : function.end_byte]
    if not kind.endswith("Listener") or (b"waitForTransform" not in after and b"canTransform" not in after):
        return False
    scope, _, last = function_name(function, view).rpartition("::")
    return (bool(scope) and scope == last) or _is_done_once(declaration, view)


def _is_done_once(declaration: Node, view: FileView) -> bool:
    """Return whether a branch that a node stands in sets what it asks for: ``if (first_) first_ = false;``."""
    branch = above(declaration, "if_statement")
    condition = branch.child_by_field_name("condition") if branch is not None else None
    if branch is None or condition is None:
        return False
    asked = set(re.findall(rb"[A-Za-z_]\w*", view.code[condition.start_byte : condition.end_byte]))
    code = view.code[condition.end_byte : branch.end_byte]
    return any(re.search(rb"\b" + name + rb"\s*=(?!=)", code) for name in asked)


RULE = FileRule(
    id="node.listener_in_callback",
    title="Transform listener or broadcaster made in a callback",
    finds="A local listener of transforms in a constructor, which ends with it. A local `TransformListener` or "
    "`TransformBroadcaster` in a callback is a note. Make it a member.",
    why="A new listener subscribes and knows no transform yet, so each look-up fails or waits; a new broadcaster has "
    "no "
    "subscriber yet, so what it sends is lost.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms", "callbacks"),
    bad="""#include <ros/ros.h>
void Arm::on_goal(const Goal & goal) { tf::TransformListener listener; listener.waitForTransform(a, b, t, d); }
void Arm::start() { sub_ = nh_.subscribe("goal", 1, &Arm::on_goal, this); }
""",
    good="""#include <ros/ros.h>
void Arm::on_goal(const Goal & goal) { listener_.waitForTransform(a, b, t, d); }
void Arm::start() { sub_ = nh_.subscribe("goal", 1, &Arm::on_goal, this); }
""",
    syntax="cpp",
    anchors=(
        *("tf::TransformListener", "tf::TransformBroadcaster", "tf2_ros::TransformListener"),
        *("tf2_ros::TransformBroadcaster", "tf2_ros::StaticTransformBroadcaster"),
    ),
    mentions=ROS_CPP,
    found=found,
)
