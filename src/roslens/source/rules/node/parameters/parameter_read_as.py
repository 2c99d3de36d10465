"""Rule ``node.parameter_read_as``: a parameter is declared with one type and read, or set, as another."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import cast

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, is_handled, receiver
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_flow.member_facts import member_fact
from roslens.source.rules.cpp_flow.variable_type import class_around
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.node.parameters.parameter_kinds import (
    declared_kind,
    read_kind,
    unknown_member,
    value_kind,
)
from roslens.source.rules.rule import RCLCPP, FileRule

_DECLARING = b"declare_parameter"
_UNTYPED = re.compile(rb"dynamic_typing|\bundeclare_parameter\b")
_GIVEN = 2
_PLAIN = ("bool", "int", "double", "string")
"""Types of members that headers tell to sources."""
_Key = tuple[str, str, str]
_Declared = Mapping[_Key, tuple[str, int] | None]


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a read of a parameter as another type than the one that the same node declares in the file."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or not given or given[0].type != "string_literal" or view.has(_UNTYPED):
        return
    declared = _declared(view).get(_key(call, given[0], view))
    if declared is None or is_handled(call):
        return
    kind, line = declared
    read = read_kind(call, view)
    if read is not None:
        if read[0] != kind:
            yield view.hit("node.parameter_read_as", read[1], _said(view.text(given[0]), kind, line, read[0]))
        return
    member = unknown_member(call, view)
    for other in _PLAIN if member else ():
        if other != kind:
            fact = member_fact(class_around(call, view), member, other)
            said = _said(view.text(given[0]), kind, line, other)
            yield view.hit("node.parameter_read_as", call, said, callback=fact)


def _said(name: str, declared: str, line: int, read: str) -> str:
    return (
        f"parameter {name} is declared as {declared} (line {line}) and read as {read}: rclcpp throws "
        "ParameterTypeException; expected one type for both"
    )


def set_otherwise(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a parameter that is made with a value of another type than the one that the node declares."""
    made = call_at(node)
    given = arguments(made) if made is not None else ()
    if made is None or len(given) != _GIVEN or given[0].type != "string_literal" or view.has(_UNTYPED):
        return
    setting = above(made, "call_expression", "compound_statement")
    while setting is not None and setting.type == "call_expression":
        name = view.text(setting.child_by_field_name("function")).rpartition(">")[2].rpartition(".")[2]
        if name in ("set_parameter", "set_parameters", "set_parameters_atomically"):
            break
        setting = above(setting, "call_expression", "compound_statement")
    if setting is None or setting.type != "call_expression":
        return
    declared = _declared(view).get(_key(setting, given[0], view))
    kind = value_kind(given[1], view)
    if declared is not None and kind and kind != declared[0]:
        yield view.hit(
            "node.parameter_read_as",
            made,
            f"parameter {view.text(given[0])} is declared as {declared[0]} (line {declared[1]}) and set as {kind}: "
            f"rclcpp refuses the value; expected one of type {declared[0]}",
        )


def _either(node: Node, view: FileView) -> Iterator[Hit]:
    return set_otherwise(node, view) if view.text(node).endswith("Parameter") else found(node, view)


def _key(call: Node, name: Node, view: FileView) -> _Key:
    """Return whose parameter a call is about: the class of the node, or the variable and function that has it."""
    of = view.text(receiver(call)).removeprefix("this")
    of_class = class_around(call, view)
    if of or not of_class:
        function = above(call, "function_definition")
        of = f"{of} {function.start_byte if function is not None and not of_class else ''}"
    return (of_class, of, view.text(name))


def _declared(view: FileView) -> _Declared:
    """Return the type of each parameter that a file declares, and the line; None where it is not known, or not one."""
    key = "declared parameters"
    known = view.kept.get(key)
    if known is None:
        found_: dict[_Key, tuple[str, int] | None] = {}
        for call, name in _declarations(view):
            place, kind = _key(call, name, view), declared_kind(call, view)
            before = found_.get(place, (kind, 0))
            is_same = bool(kind) and before is not None and before[0] == kind
            found_[place] = (kind, call.start_point[0] + 1) if is_same else None
        known = view.kept[key] = found_
    return cast("_Declared", known)


def _declarations(view: FileView) -> Iterator[tuple[Node, Node]]:
    for at in word_places(_DECLARING, view):
        word = view.node_at(at, at + len(_DECLARING))
        call = call_at(word) if word is not None else None
        given = arguments(call) if call is not None else ()
        if call is not None and given and given[0].type == "string_literal":
            yield call, given[0]


RULE = FileRule(
    id="node.parameter_read_as",
    title="Parameter declared with one type and read as another",
    finds="`get_parameter` or `get_parameter_or` into a variable, or by `as_int()` and its like, of another type than "
    "the one with which the same node declares the parameter in the file; `set_parameter` with a value of another "
    "type. An integer literal declares an integer: `declare_parameter(name, 5.0)` for a double.",
    why="Parameters of rclcpp have one type, and integers are not converted: reading another one throws, mostly at "
    "start. Where it is set, the value is refused and the result that says so is rarely looked at.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("parameters",),
    bad="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { declare_parameter("limit", 5); double limit = 0.0; get_parameter("limit", limit); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
Arm::Arm() : Node("arm") { declare_parameter("limit", 5.0); double limit = 0.0; get_parameter("limit", limit); }
""",
    syntax="cpp",
    anchors=("get_parameter", "get_parameter_or", "rclcpp::Parameter"),
    mentions=RCLCPP,
    found=_either,
)
