"""Rule ``node.parameter_unchecked``: a variable that keeps what was in memory where a parameter is not set."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, body_of, call_at, function_around, is_discarded
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_PLAIN = r"(?:bool|int|unsigned|unsigned int|double|float|u?int\d+_t|size_t|long)"
_PAIR = 2


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that reads a parameter into a plain variable without a value, and whose result is dropped."""
    call, function = call_at(node), function_around(node)
    body = body_of(function) if function is not None else None
    given = arguments(call) if call is not None else ()
    if call is None or body is None or len(given) != _PAIR or not is_discarded(call) or given[1].type != "identifier":
        return
    # A parameter that was declared has a value.
    if view.text(node) == "get_parameter" and (b"declare" in view.code or b"add_parameter" in view.code):
        return
    name = view.text(given[1])
    before = " ".join(view.code[body.start_byte : call.start_byte].decode("utf-8", "replace").split())
    if not re.search(rf"[;{{}}] {_PLAIN} (?:\w+, )*{name}(?:, \w+)*;", before):
        return
    if "hasParam" in before or "has_parameter" in before:
        return
    if re.search(rf"\b{name} = |\b{name}\)|>> {name}\b", before) or _is_asked_elsewhere(given[0], call, view):
        return
    yield view.hit(
        "node.parameter_unchecked",
        call,
        f"`{view.text(call)}` leaves `{name}` without a value where the parameter is not set, and nothing asks; "
        "expected "
        "`if (!...)`, or a default",
    )


def _is_asked_elsewhere(name: Node, call: Node, view: FileView) -> bool:
    """Return whether the file asks in a condition for a parameter of the same name, or sets it."""
    if name.type != "string_literal":
        return False
    text = view.source[name.start_byte : name.end_byte]
    others = view.source[: call.start_byte] + view.source[call.end_byte :]
    if text not in others:
        return False
    return (
        re.search(
            rb"(?:\bif\s*\([^;{]*|[sS]et_?[pP]aram\w*\s*\(\s*|[hH]as_?[pP]aram\w*\s*\(\s*)" + re.escape(text), others
        )
        is not None
    )


RULE = FileRule(
    id="node.parameter_unchecked",
    title="Result of getParam unchecked",
    finds="`getParam` or `get_parameter` into a number that has no value yet, as a statement of its own. Ask for its "
    "result, "
    "or use `param(name, variable, default)`.",
    why="Where the parameter is not set, a misspelt launch file is enough, the variable holds what was in memory: a "
    "speed "
    "limit of 1e-310 on one start and of 1e80 on the next.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("parameters",),
    bad='#include <ros/ros.h>\nvoid f() { double limit; nh.getParam("limit", limit); use(limit); }\n',
    good='#include <ros/ros.h>\nvoid f() { double limit; nh.param("limit", limit, 0.5); use(limit); }\n',
    syntax="cpp",
    anchors=("getParam", "get_parameter", "param::get", "getParamCached"),
    mentions=ROS_CPP,
    found=found,
)
