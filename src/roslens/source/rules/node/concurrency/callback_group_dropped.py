"""Rule ``node.callback_group_dropped``: a callback group that nobody keeps."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name, function_name
from roslens.source.rules.calls import arguments, call_at, function_around
from roslens.source.rules.cpp_flow.keeper import keeper_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_KEEP_NONE = frozenset(("create_wall_timer", "create_timer", "create_client", "create_service"))
_STAYS = re.compile(rb"spin|\bok\s*\(|add_callback_group|\bwait_for\b|\bwait\s*\(")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a group in a local variable that is handed to timers, services and clients alone."""
    call, function = call_at(node), function_around(node)
    keeper = keeper_of(call, view) if call is not None else None
    if call is None or function is None or keeper is None:
        return
    if function.type != "function_definition" or any(view.text(one) == "false" for one in arguments(call)):
        return
    # What `main` keeps lasts as long as the program, but for that of a block in it.
    is_of_main = function_name(function, view) == "main" and keeper.scope_kind == "function"
    if is_of_main or _STAYS.search(view.code[keeper.block.start_byte : keeper.block.end_byte]):
        return
    uses = [one for one in keeper.uses(view) if not call.start_byte <= one.start_byte < call.end_byte]
    handed = [one for one in uses if not _is_set(one)]
    if handed and all(_is_handed_over(use, view) for use in handed):
        yield view.hit(
            "node.callback_group_dropped",
            call,
            f"`{keeper.name}` keeps its callback group only until this {keeper.scope_kind} ends: the node holds it "
            "weakly, and its callbacks never run afterwards; expected a member",
        )


def _is_set(use: Node) -> bool:
    around = use.parent
    is_assigned = around is not None and around.type == "assignment_expression"
    return around is not None and is_assigned and around.child_by_field_name("left") == use


def _is_handed_over(use: Node | None, view: FileView) -> bool:
    """Tell whether a use is an argument of what keeps no group; a subscription and a publisher keep their options."""
    call = use.parent.parent if use is not None and use.parent is not None else None
    return call is not None and call.type == "call_expression" and callee_name(call, view) in _KEEP_NONE


RULE = FileRule(
    id="node.callback_group_dropped",
    title="Callback group not kept",
    finds="A callback group in a local variable of a function that returns, or of a block that "
    "ends, used for subscriptions, timers, services "
    "or "
    "clients. Keep it in a member.",
    why="Node and executor hold groups weakly: when the variable is gone, so is the group, and no callback of it ever "
    "runs. "
    "Nothing says so.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("concurrency", "callbacks"),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") {
  auto group = create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  timer_ = create_wall_timer(1s, [this] { tick(); }, group);
}
""",
    good="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") {
  group_ = create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  timer_ = create_wall_timer(1s, [this] { tick(); }, group_);
}
""",
    syntax="cpp",
    anchors=("create_callback_group",),
    mentions=RCLCPP,
    found=found,
)
