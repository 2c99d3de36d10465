"""Rule ``node.spin_in_constructor``: a constructor that never returns."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import call_at, function_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that spins for ever in a constructor."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or function.type != "function_definition":
        return
    scope, _, last = function_name(function, view).rpartition("::")
    if scope and scope == last:
        yield view.hit(
            "node.spin_in_constructor",
            call,
            f"`{view.text(call)}` in the constructor of `{last}`, which does not return before shutdown; expected it "
            "in "
            "`main`",
        )


RULE = FileRule(
    id="node.spin_in_constructor",
    title="Constructor that spins",
    finds="`ros::spin()` or `rclcpp::spin(...)` in a constructor. Spin in `main`.",
    why="The object does not exist until shutdown: what derives from it, is composed with it or comes after it never "
    "begins, and callbacks run on members that are not made yet.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("lifetime",),
    bad="#include <ros/ros.h>\nArm::Arm() { sub_ = n_.subscribe(a, 1, &Arm::on, this); ros::spin(); }\n",
    good="#include <ros/ros.h>\nArm::Arm() { sub_ = n_.subscribe(a, 1, &Arm::on, this); }\n",
    syntax="cpp",
    anchors=("ros::spin", "rclcpp::spin"),
    mentions=ROS_CPP,
    found=found,
)
