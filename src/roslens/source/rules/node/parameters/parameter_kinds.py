"""Of which type a parameter of rclcpp is that a call declares, and as which a call reads it."""

from __future__ import annotations

import re
from collections.abc import Mapping

from tree_sitter import Node

from roslens.source.rules.calls import arguments, call_at, receiver, template_argument
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_flow.member_facts import kind_of
from roslens.source.rules.cpp_flow.variable_type import local_declaration, type_of
from roslens.source.rules.file_view import FileView

_AS: Mapping[str, str] = {
    "as_bool": "bool",
    "as_int": "int",
    "as_double": "double",
    "as_string": "string",
    "as_bool_array": "bool_array",
    "as_integer_array": "int_array",
    "as_double_array": "double_array",
    "as_string_array": "string_array",
    "as_byte_array": "byte_array",
}
"""Methods of a parameter, by the type that they ask for."""
_NAMED: Mapping[str, str] = {
    "PARAMETER_BOOL": "bool",
    "PARAMETER_INTEGER": "int",
    "PARAMETER_DOUBLE": "double",
    "PARAMETER_STRING": "string",
    "PARAMETER_BYTE_ARRAY": "byte_array",
    "PARAMETER_BOOL_ARRAY": "bool_array",
    "PARAMETER_INTEGER_ARRAY": "int_array",
    "PARAMETER_DOUBLE_ARRAY": "double_array",
    "PARAMETER_STRING_ARRAY": "string_array",
}
_READING = ("get_value", "get")
_VECTOR = re.compile(r"std::vector<\s*([\w:]+)\s*>")
_INTEGER = re.compile(r"[+-]?(?:0[xX][\da-fA-F]+|\d+)[uUlL]*")
_DOUBLE = re.compile(r"[+-]?(?:\d+\.\d*|\.\d+|\d+(?=[eE]))(?:[eE][+-]?\d+)?[fFlL]?")
_STRING = re.compile(r'(?:std::string\s*[({]\s*)?"')
_WRAPPED = re.compile(r"(?:rclcpp::)?ParameterValue\s*[({](.*)[)}]$", re.DOTALL)
_MADE = re.compile(r"(?:static_cast<\s*([\w:<> ]+?)\s*>\s*\(|((?:std::)?[\w:]+(?:<\s*[\w:]+\s*>)?)\s*[({])")
_NAME = re.compile(r"(?:this->)?\w+")


def kind_of_type(written: str) -> str:
    """Return the type of parameters that a type of C++ stands for, such as ``int`` for ``uint8_t``."""
    of = _VECTOR.fullmatch(written.strip())
    if of is None:
        return kind_of(written.strip())
    # A vector of bytes is a byte array, and what a vector of other integers converts to is not the same everywhere.
    if of[1] in ("uint8_t", "std::uint8_t"):
        return "byte_array"
    inner = kind_of(of[1])
    return f"{inner}_array" if inner in ("bool", "int", "double", "string") else ""


def declared_kind(call: Node, view: FileView) -> str:
    """Return the type that a call of ``declare_parameter`` declares; empty where it does not tell."""
    by_template = kind_of_type(template_argument(call, view))
    if by_template:
        return by_template
    given = arguments(call)
    return value_kind(given[1], view) if len(given) > 1 and not template_argument(call, view) else ""


def value_kind(value: Node, view: FileView) -> str:
    """Return the type of a parameter that an expression makes; empty where it is not known."""
    text = view.text(value)
    wrapped = _WRAPPED.match(text)
    if wrapped is not None:
        text = wrapped[1].strip()
    if text.rpartition("::")[2] in _NAMED:
        return _NAMED[text.rpartition("::")[2]]
    if text in ("true", "false"):
        return "bool"
    if _INTEGER.fullmatch(text):
        return "int"
    if _DOUBLE.fullmatch(text):
        return "double"
    if _STRING.match(text):
        return "string" if re.fullmatch(r'(?:std::string\s*[({]\s*)?"(?:[^"\\\\]|\\\\.)*"\s*[)}]?', text) else ""
    if _NAME.fullmatch(text):
        return kind_of_type(type_of(text, value, view))
    made = _MADE.match(text)
    return kind_of_type(made[1] or made[2]) if made is not None and text.endswith((")", "}")) else ""


def read_kind(call: Node, view: FileView) -> tuple[str, Node] | None:
    """Return as which type a call of ``get_parameter`` or ``get_parameter_or`` reads, and where; None if not known."""
    given = arguments(call)
    if len(given) > 1:
        by_template = kind_of_type(template_argument(call, view))
        text = view.text(given[1])
        kind = by_template or (kind_of_type(type_of(text, call, view)) if _NAME.fullmatch(text) else "")
        return (kind, call) if kind else None
    if len(given) != 1:
        return None
    method = _method_of(call)
    if method is not None:
        return _read_by(method, view)
    declared = call.parent
    if declared is None or declared.type != "init_declarator":
        return None
    return _read_through(view.text(declared.child_by_field_name("declarator")), declared, view)


def unknown_member(call: Node, view: FileView) -> str:
    """Return the variable that a call reads into where it is a member that only another file declares; else empty."""
    given = arguments(call)
    name = view.text(given[1]).removeprefix("this->") if len(given) > 1 else ""
    if not name.isidentifier() or template_argument(call, view) or local_declaration(name, call, view) is not None:
        return ""
    return "" if type_of(name, call, view) else name


def _read_by(method: Node, view: FileView) -> tuple[str, Node] | None:
    """Return what the call of a method of a parameter asks for."""
    name = view.text(method.child_by_field_name("function")).rpartition(".")[2].rpartition("->")[2]
    plain = name.partition("<")[0]
    if plain == "get_parameter_value":
        further = _method_of(method)
        return _read_by(further, view) if further is not None else None
    kind = _AS.get(plain, "")
    if plain in _READING:
        kind = kind_of_type(template_argument(method, view))
    return (kind, method) if kind else None


def _read_through(name: str, declared: Node, view: FileView) -> tuple[str, Node] | None:
    """Return what the first method asks for that is called of a variable, where all agree."""
    block = declared.parent.parent if declared.parent is not None else None
    if block is None or not name.isidentifier():
        return None
    found: list[tuple[str, Node]] = []
    for at in word_places(name.encode(), view, declared.end_byte, block.end_byte):
        word = view.node_at(at, at + len(name))
        method = _method_of(word) if word is not None else None
        read = _read_by(method, view) if method is not None else None
        if read is not None:
            found.append(read)
    return found[0] if found and len({kind for kind, _ in found}) == 1 else None


def _method_of(of: Node) -> Node | None:
    """Return the call of a method of an expression."""
    around = of.parent
    if around is None or around.type != "field_expression" or around.child_by_field_name("argument") != of:
        return None
    field = around.child_by_field_name("field")
    call = call_at(field) if field is not None else None
    if call is None and field is not None and field.type in ("template_method", "dependent_name"):
        call = around.parent if around.parent is not None and around.parent.type == "call_expression" else None
    return call if call is not None and receiver(call) == of else None
