"""Rule ``node.transform_unhandled``: a look-up of a transform that nobody catches."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_handled, receiver
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_ASKS_FIRST = re.compile(rb"canTransform|waitForTransform|\btry\b")
_ASKED = rb"!\s*%(n)s\b|\b%(n)s(?:\.|->)(?:has_value|value|error|is_initialized)\b|if\s*\(\s*%(n)s\s*[)&|]"
_FEWEST = 3


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a look-up outside of ``try``, in a callback that neither asks nor waits before."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    if (
        call is None
        or body is None
        or receiver(call) is None
        or len(arguments(call)) < _FEWEST
        or is_handled(call)
        or _is_asked(call, body, view)
    ):
        return
    callback = callback_around(call, view)
    if callback is not None and not _ASKS_FIRST.search(view.code[body.start_byte : call.start_byte]):
        yield view.hit(
            "node.transform_unhandled",
            call,
            f"`{view.short(call, 80)}` outside of `try`: it throws until the transform is known, which no callback "
            "survives; expected a handler of tf2::TransformException",
            callback=callback,
        )


def _is_asked(call: Node, body: Node, view: FileView) -> bool:
    """Tell whether it is asked of what the look-up returns if there is anything: such a look-up does not throw."""
    kept = call.parent
    name = kept.child_by_field_name("declarator") if kept is not None and kept.type == "init_declarator" else None
    if name is None:
        return False
    asked = _ASKED % {b"n": re.escape(view.text(name).encode())}
    return re.search(asked, view.code[call.end_byte : body.end_byte]) is not None


RULE = FileRule(
    id="node.transform_unhandled",
    title="Unhandled exception of a transform look-up",
    finds="`lookupTransform` outside of `try`, in a callback that neither asks `canTransform` nor waits before. Catch "
    "`tf2::TransformException` and go on without.",
    why="At start, and whenever a localisation is late, the transform is not there, and the look-up throws: the node "
    "ends "
    "in the middle of a drive.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("transforms", "exceptions"),
    bad="#include <rclcpp/rclcpp.hpp>\nvoid Arm::start() { t_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }\n"
    "void Arm::tick() { t_ = buffer_->lookupTransform(a, b, tf2::TimePointZero); }\n",
    good="#include <rclcpp/rclcpp.hpp>\nvoid Arm::start() "
    "{ t_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }\n"
    "void Arm::tick() {\n"
    "  try { t_ = buffer_->lookupTransform(a, b, tf2::TimePointZero); } catch (const tf2::TransformException & e) "
    "{ wait(e); }\n"
    "}\n",
    syntax="cpp",
    anchors=("lookupTransform",),
    mentions=ROS_CPP,
    spares_tests=True,
    found=found,
)
