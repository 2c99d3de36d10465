"""Of which clock a time of rclcpp is, as far as one file tells: times of two clocks cannot be compared."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_flow.variable_type import local_declaration, type_of
from roslens.source.rules.cpp_statement import plain
from roslens.source.rules.file_view import FileView, above

ROS, SYSTEM, STEADY = "ROS time", "the system's clock", "the steady clock"
_NAMED = {"RCL_ROS_TIME": ROS, "RCL_SYSTEM_TIME": SYSTEM, "RCL_STEADY_TIME": STEADY}
_OF_NODE = re.compile(r"(?:this->)?(?:\w*node\w*(?:\(\))?(?:->|\.))?(?:get_clock\(\)->)?now\(\)")
_MADE_CLOCK = re.compile(r"\(?rclcpp::Clock\s*[({]([^(){}]*)[)}]\)?\.now\(\)")
_OF_CLOCK = re.compile(r"((?:this->)?\w+)(?:\.|->)now\(\)")
_MADE_TIME = re.compile(r"rclcpp::Time\s*[({](.*)[)}]", re.DOTALL)
_STAMP = re.compile(r"\bheader(?:\.|->)stamp$")
_NUMBERS = re.compile(r"[\d.eE+\-,\s]*")
_NAME = re.compile(r"(?:this->)?[A-Za-z_]\w*")
_CLOCKS = re.compile(r"(?:std::(?:shared|unique)_ptr<)?\s*rclcpp::Clock\b.*")
_DEEPEST = 4


def clock_of(node: Node | None, view: FileView, depth: int = 0) -> str:
    """Return the clock of a time: :data:`ROS`, :data:`SYSTEM`, :data:`STEADY`; empty where it is not known."""
    value = plain(node)
    if value is None or depth > _DEEPEST:
        return ""
    text = view.text(value)
    if _OF_NODE.fullmatch(text) or (value.type == "field_expression" and _STAMP.search(text)):
        return ROS
    made = _MADE_CLOCK.fullmatch(text)
    if made is not None:
        return _named_in(made[1]) or ("" if made[1].strip() else SYSTEM)
    read = _OF_CLOCK.fullmatch(text)
    if read is not None:
        return _of_clock(read[1], value, view)
    time = _MADE_TIME.fullmatch(text)
    if time is not None:
        return _of_time(time[1].strip())
    return _of_variable(text, value, view, depth) if _NAME.fullmatch(text) else ""


def _named_in(text: str) -> str:
    found = {clock for name, clock in _NAMED.items() if name in text}
    return found.pop() if len(found) == 1 else ""


def _of_time(given: str) -> str:
    """Return the clock of a time that is made: of a stamp it is ROS time, of numbers the system's."""
    if "RCL_" in given or "clock_type" in given:
        return _named_in(given)
    if _STAMP.search(given) and "," not in given:
        return ROS
    return SYSTEM if _NUMBERS.fullmatch(given) else ""


def _of_clock(name: str, node: Node, view: FileView) -> str:
    """Return which clock a variable is, by all that the file makes it with."""
    kind = type_of(name, node, view)
    if not _CLOCKS.fullmatch(kind):
        return ""
    plain_name = name.removeprefix("this->")
    made = re.findall(rf"\b{plain_name}\s*(?:=\s*|[({{])([^;]*)", view.code.decode("utf-8", "replace"))
    if not made:
        return SYSTEM if kind == "rclcpp::Clock" else ""
    found = {_named_in(one) for one in made}
    return found.pop() if len(found) == 1 else ""


def _of_variable(text: str, node: Node, view: FileView, depth: int) -> str:
    name = text.removeprefix("this->")
    local = local_declaration(name, node, view) if name == text else None
    if local is None and type_of(text, node, view) != "rclcpp::Time":
        return ""
    scope = above(local, "function_definition") if local is not None else view.root
    if scope is None or (local is not None and local.type != "declaration"):
        return ""
    found = set()
    for value in _values(name, scope, view):
        if value is None or value.start_byte <= node.start_byte < value.end_byte:
            return ""
        found.add(clock_of(value, view, depth + 1))
    return found.pop() if len(found) == 1 else ""


def _values(name: str, scope: Node, view: FileView) -> Iterator[Node | None]:
    """Yield what a variable is made with or assigned; None for what cannot be followed."""
    for at in word_places(name.encode(), view, scope.start_byte, scope.end_byte):
        word = view.node_at(at, at + len(name))
        around = word.parent if word is not None else None
        if around is not None and around.type == "field_expression" and view.text(around) == f"this->{name}":
            word, around = around, around.parent
        if word is not None and around is not None and _is_set(word, around, view):
            yield _value(word, around)


def _is_set(word: Node, around: Node, view: FileView) -> bool:
    """Return whether a variable gets a value where it is named, or may get one."""
    match around.type:
        case "assignment_expression":
            return around.child_by_field_name("left") == word
        case "init_declarator":
            return around.child_by_field_name("declarator") == word
        case "field_initializer":
            return around.named_children[0] == word
        case "field_declaration":
            # A member without a value has that of its first assignment, as far as is asked here.
            return around.child_by_field_name("default_value") is not None
        case "pointer_expression":
            return view.text(around).startswith("&")
    return around.type == "function_declarator"


def _value(word: Node, around: Node) -> Node | None:
    """Return the value that a variable gets where it is named; None where it is not seen."""
    if around.type == "assignment_expression":
        return around.child_by_field_name("right") if around.child_by_field_name("left") == word else None
    if around.type == "init_declarator":
        return _made_with(around.child_by_field_name("value"))
    return _made_with(around.named_children[-1]) if around.type == "field_initializer" else None


def _made_with(value: Node | None) -> Node | None:
    if value is not None and value.type in ("argument_list", "initializer_list"):
        return value.named_children[0] if value.named_child_count == 1 else None
    return value
