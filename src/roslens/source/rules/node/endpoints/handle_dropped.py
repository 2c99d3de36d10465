"""Rule ``node.handle_dropped``: a subscription, timer or service that ends where it was made."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, is_discarded
from roslens.source.rules.cpp_flow.keeper import keeper_of
from roslens.source.rules.cpp_flow.local_lambda import local_lambda
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_CALLBACK = re.compile(r"&\s*\w+(::\w+)+|\bbind\s*\(|^\[")
_NODE = re.compile(r"\*?(?:this\b|\w*(?:node|nh)(?:_?handle)?_*$|n_*$|\w*n_?h_*$)", re.IGNORECASE)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call whose handle nobody keeps."""
    call = call_at(node)
    if call is None:
        return
    name, given = view.text(node), arguments(call)
    if len(given) < 2 or not any(_is_callback(one, call, view) for one in given[1:]):
        return
    if is_discarded(call):
        # Of a class of one's own, which gets the node as an argument and keeps what it makes, or is around the call.
        if _NODE.match(view.text(given[0])) or (
            name == view.text(call.child_by_field_name("function")) and _of_ros1(name)
        ):
            return
        yield view.hit(
            "node.handle_dropped",
            call,
            f"the handle that `{name}` returns is dropped: it ends at once and its callback never runs; expected a "
            "member that keeps it",
        )
        return
    keeper = keeper_of(call, view)
    if keeper is not None and keeper.ends_early(view):
        yield view.hit(
            "node.handle_dropped",
            call,
            f"`{keeper.name}` keeps what `{name}` returns only until this {keeper.scope_kind} ends, then its callback "
            "never runs; expected a member that keeps it",
        )


def _of_ros1(name: str) -> bool:
    """Return whether a function is one of a node handle of ROS 1, which is called by an object."""
    return not name.startswith("create_")


def _is_callback(argument: Node, call: Node, view: FileView) -> bool:
    """Return whether an argument is a function, or a variable of the function around that holds a lambda."""
    text = view.text(argument)
    if _CALLBACK.search(text):
        return True
    name = re.fullmatch(r"(?:std::move\()?(\w+)\)?", text)
    return name is not None and local_lambda(name[1], call, view) is not None


RULE = FileRule(
    id="node.handle_dropped",
    title="Handle of a subscription, timer or service not kept",
    finds="A call that makes a subscription, a timer or a service and whose result is dropped, or kept only by a local "
    "variable of a function that returns, or of a block that ends before the node spins. Keep it in a member.",
    why="The handle is the endpoint: when the last copy is gone, the subscription is closed and the timer stopped. The "
    "node starts without an error and never reacts.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("endpoints",),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { create_wall_timer(100ms, [this] { tick(); }); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { timer_ = create_wall_timer(100ms, [this] { tick(); }); }
""",
    syntax="cpp",
    anchors=(
        *("create_subscription", "create_generic_subscription", "create_wall_timer", "create_timer", "create_service"),
        *("subscribe", "advertiseService", "createTimer", "createWallTimer", "createSteadyTimer"),
    ),
    mentions=ROS_CPP,
    found=found,
)
