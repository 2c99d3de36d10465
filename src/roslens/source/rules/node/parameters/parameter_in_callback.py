"""Rule ``node.parameter_in_callback``: a callback that asks the master for a parameter."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import arguments, call_at, function_around, is_conditional
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROSCPP, FileRule

_PAIR = 2
_ASKED = re.compile(rb"\bgetParam\b|\bparam\b\s*[<(]|param::")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call of the parameter server that each message or tick makes."""
    call, function = call_at(node), function_around(node)
    if call is None or function is None or len(arguments(call)) < _PAIR or is_conditional(call, function):
        return
    body = function.child_by_field_name("body")
    head = view.code[function.start_byte : body.start_byte if body is not None else function.end_byte]
    if b"TimerEvent" in head or b"()" in head or _ASKED.search(view.code[function.start_byte : call.start_byte]):
        return
    callback = callback_around(call, view, of_stream=True)
    if callback is not None:
        yield view.hit(
            "node.parameter_in_callback",
            call,
            f"`{view.text(call)}` in {spoken(callback)} asks the master each time; expected it read once, "
            "`getParamCached`, or dynamic_reconfigure",
            callback=callback,
        )


RULE = FileRule(
    id="node.parameter_in_callback",
    title="Parameter server asked in a callback",
    finds="`getParam` or `param` in a callback of a subscription, once a callback. Read it once, or use "
    "`getParamCached`.",
    why="Each call is a TCP connection to the master: where it is slow or gone, the callback waits, and with it all "
    "others.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=("ros1",),
    tags=("parameters", "callbacks", "real-time"),
    bad="""#include <ros/ros.h>
void Arm::on_goal(const Goal & goal) { nh_.getParam("limit", limit_); }
void Arm::start() { sub_ = nh_.subscribe("goal", 1, &Arm::on_goal, this); }
""",
    good="""#include <ros/ros.h>
void Arm::on_goal(const Goal & goal) { move(limit_); }
void Arm::start() { nh_.getParam("limit", limit_); sub_ = nh_.subscribe("goal", 1, &Arm::on_goal, this); }
""",
    syntax="cpp",
    anchors=("getParam", "param", "param::get", "param::param"),
    mentions=ROSCPP,
    found=found,
)
