"""Rule ``node.unlocked_state``: a member that callbacks of several threads write, without a lock."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.callbacks import callbacks_of, function_name
from roslens.source.rules.calls import body_of, call_at
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_LOCKED = re.compile(rb"mutex|atomic|lock_guard|unique_lock|scoped_lock|Realtime|realtime_tools")
_WRITTEN = re.compile(
    rb"(?<![\w.>])(\w+_)\s*(?:=(?!=)|\+=|-=|\+\+|\.(?:push_back|clear|insert|erase|emplace_back)\s*\()"
)


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a reentrant group in a file whose callbacks write one member in two of them, where no lock is in sight."""
    call = call_at(node)
    if call is None or b"Reentrant" not in view.text(call).encode() or _LOCKED.search(view.code):
        return
    registered = set(callbacks_of(view))
    writers: dict[bytes, set[str]] = {}
    for function in below(view.root, "function_definition"):
        name, body = function_name(function, view), body_of(function)
        if body is None or name not in registered:
            continue
        for match in _WRITTEN.finditer(view.code[body.start_byte : body.end_byte]):
            writers.setdefault(match[1], set()).add(name)
    for member, names in sorted(writers.items()):
        if len(names) > 1:
            one, other = sorted(names)[:2]
            yield view.hit(
                "node.unlocked_state",
                call,
                f"`{member.decode('utf-8', 'replace')}` is written by `{one}` and `{other}`, which a reentrant group "
                "may run at "
                "once, and this file has no lock; expected a mutex around it",
            )
            return


RULE = FileRule(
    id="node.unlocked_state",
    title="State of concurrent callbacks without a lock",
    finds="A file with a reentrant callback group in which two callbacks write one member, and no mutex or atomic. "
    "Lock it, or "
    "use a mutually exclusive group.",
    why="Callbacks of a reentrant group run at once in a multi-threaded executor: what both write is torn, and a "
    "container "
    "that one changes under the other crashes, once a week.",
    profiles=("ros2",),
    tags=("concurrency",),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") {
  group_ = create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  a_ = create_subscription<Goal>("a", 1, std::bind(&Arm::on_a, this, _1), options_);
  b_ = create_subscription<Goal>("b", 1, std::bind(&Arm::on_b, this, _1), options_);
}
void Arm::on_a(const Goal::SharedPtr goal) { goals_.push_back(*goal); }
void Arm::on_b(const Goal::SharedPtr) { goals_.clear(); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") {
  group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  a_ = create_subscription<Goal>("a", 1, std::bind(&Arm::on_a, this, _1), options_);
  b_ = create_subscription<Goal>("b", 1, std::bind(&Arm::on_b, this, _1), options_);
}
void Arm::on_a(const Goal::SharedPtr goal) { goals_.push_back(*goal); }
void Arm::on_b(const Goal::SharedPtr) { goals_.clear(); }
""",
    syntax="cpp",
    anchors=("create_callback_group",),
    mentions=RCLCPP,
    found=found,
)
