"""Rule ``node.handle_dropped``: a subscription, timer or service that ends where it was made."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_discarded
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_CALLBACK = re.compile(r"&\s*\w+(::\w+)+|\bbind\s*\(|^\[")
_BEGINNINGS = frozenset(
    ("onInit", "init", "initialize", "setup", "on_configure", "on_activate", "configure", "onConfigure")
)
_NODE = re.compile(r"\*?(?:this\b|\w*(?:node|nh)(?:_?handle)?_*$|n_*$|\w*n_?h_*$)", re.IGNORECASE)
_STAYS = re.compile(rb"\bspin|\bwaitForShutdown\b|\bok\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call whose handle nobody keeps."""
    call = call_at(node)
    if call is None:
        return
    name, given = view.text(node), arguments(call)
    if len(given) < 2 or not any(_CALLBACK.search(view.text(one)) for one in given[1:]):
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
    local = _unused_local(call, view)
    if local:
        yield view.hit(
            "node.handle_dropped",
            call,
            f"`{local}` keeps what `{name}` returns only until this function ends, then its callback never runs; "
            "expected a member that keeps it",
        )


def _of_ros1(name: str) -> bool:
    """Return whether a function is one of a node handle of ROS 1, which is called by an object."""
    return not name.startswith("create_")


def _unused_local(call: Node, view: FileView) -> str:
    """Return the name of the local variable that alone keeps a handle, in a function that sets up a node."""
    declared = call.parent
    function = function_around(call)
    if declared is None or declared.type != "init_declarator" or function is None or declared.parent is None:
        return ""
    qualified = function_name(function, view) if function.type == "function_definition" else ""
    scope, _, last = qualified.rpartition("::")
    body, name = body_of(function), view.text(declared.child_by_field_name("declarator"))
    if body is None or not scope or (scope != last and last not in _BEGINNINGS) or not name.isidentifier():
        return ""
    if view.text(declared.parent).startswith("static "):
        return ""
    code = view.code[body.start_byte : body.end_byte]
    if _STAYS.search(code) or len(re.findall(rb"\b" + name.encode() + rb"\b", code)) > 1:
        return ""
    return name


RULE = FileRule(
    id="node.handle_dropped",
    title="Handle of a subscription, timer or service not kept",
    finds="A call that makes a subscription, a timer or a service and whose result is dropped, or kept only in a local "
    "variable of a constructor. Keep it in a member.",
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
