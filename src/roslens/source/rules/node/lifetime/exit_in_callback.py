"""Rule ``node.exit_in_callback``: a callback that ends the process."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at, function_around, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_EXECUTES = re.compile(rb"\bexec[lv]p?e?\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that ends the process in a callback."""
    call = call_at(node)
    if call is None or receiver(call) is not None:
        return
    function = function_around(call)
    if function is not None and _EXECUTES.search(view.code, function.start_byte, function.end_byte):
        return  # the child of a fork, which has not become what it should
    callback = callback_around(call, view)
    if callback is not None:
        yield view.hit(
            "node.exit_in_callback",
            call,
            f"`{view.text(call)}` in {spoken(callback)} ends the process with no destructor run; expected "
            + ("`rclcpp::shutdown()`" if view.mentions((b"rclcpp",)) else "`ros::shutdown()`")
            + ", and `main` to return",
            callback=callback,
        )


RULE = FileRule(
    id="node.exit_in_callback",
    title="Callback that ends the process",
    finds="`exit`, `abort`, `_exit`, `quick_exit` or `std::terminate` in a callback. Call `shutdown()` and let `main` "
    "return. `exit(0)`, which ends what is done, is a note.",
    why="Destructors of the node do not run: drivers are not stopped, the last velocity stays, and in a "
    "container all "
    "other components end too.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2", "ros1"),
    tags=("lifetime", "callbacks"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::on_stop(const Stop::SharedPtr) { exit(1); }
void Arm::start() { sub_ = create_subscription<Stop>("stop", 10, std::bind(&Arm::on_stop, this, _1)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::on_stop(const Stop::SharedPtr) { rclcpp::shutdown(); }
void Arm::start() { sub_ = create_subscription<Stop>("stop", 10, std::bind(&Arm::on_stop, this, _1)); }
""",
    syntax="cpp",
    anchors=("exit", "abort", "_exit", "quick_exit", "std::terminate"),
    mentions=ROS_CPP,
    found=found,
)
