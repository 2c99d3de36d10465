"""Rule ``node.unlocked_state``: a member that callbacks of several threads write, without a lock."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import REGISTERING_CPP, callbacks_of, callee_name, function_name
from roslens.source.rules.calls import body_of, call_at
from roslens.source.rules.file_view import FileView, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_LOCKED = re.compile(rb"mutex|atomic|lock_guard|unique_lock|scoped_lock|Realtime|realtime_tools")
_WRITTEN = re.compile(
    rb"(?<![\w.>])(\w+_)\s*(?:=(?!=)|\+=|-=|\+\+|\.(?:push_back|clear|insert|erase|emplace_back)\s*\()"
)

_ONE_THREAD = re.compile(rb"\brclcpp::spin(?:_some)?\s*\(|SingleThreadedExecutor")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a reentrant group in a file whose callbacks write one member in two of them, where no lock is in sight."""
    call = call_at(node)
    if call is None or "Reentrant" not in view.text(call) or _LOCKED.search(view.code) or _ONE_THREAD.search(view.code):
        return
    registered = _callbacks_in(call, view)
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


def _callbacks_in(made: Node, view: FileView) -> set[str]:
    """Return the callbacks that are registered in the group that a call makes, by its name or that of its options."""
    around = made.parent
    while around is not None and around.type not in ("assignment_expression", "init_declarator"):
        if around.type in ("compound_statement", "translation_unit"):
            return set()
        around = around.parent
    target = (
        around.child_by_field_name("left" if around.type == "assignment_expression" else "declarator")
        if around
        else None
    )
    group = view.text(target).rpartition("->")[2].rpartition(".")[2]
    if not group.isidentifier():
        return set()
    handed = rf"(\w+)\s*(?:\.|->)\s*callback_group\s*=\s*(?:this->)?{group}\b"
    options = set(re.findall(handed, view.code.decode("utf-8", "replace")))
    used = re.compile(rf"\b(?:{'|'.join(map(re.escape, (group, *options)))})\b")
    registered = set(callbacks_of(view))
    found_: set[str] = set()
    for call in below(view.root, "call_expression"):
        if callee_name(call, view) not in REGISTERING_CPP:
            continue
        text = view.text(call)
        if used.search(text):
            found_ |= {one for one in registered if re.search(rf"\b{re.escape(one.rpartition('::')[2])}\b", text)}
    return found_


RULE = FileRule(
    id="node.unlocked_state",
    title="State of concurrent callbacks without a lock",
    finds="A file with a reentrant callback group in which two callbacks write one member, and no mutex or atomic. "
    "Lock it, or "
    "use a mutually exclusive group.",
    why="Callbacks of a reentrant group run at once in a multi-threaded executor: what both write is torn, and a "
    "container "
    "that one changes under the other crashes, once a week.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros2",),
    tags=("concurrency",),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") {
  group_ = create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  options_.callback_group = group_;
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
