"""Rule ``cpp.uninitialised_member``: a member that no constructor sets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import (
    bases_of,
    class_name,
    function_declarator,
    members_of,
    name_node,
    parameters_of,
)
from roslens.source.rules.file_view import FileView, above, below
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_SECOND_STEP = re.compile(
    r"(?:on_?)?(?:configure|init|setup|set_?up|reset|clear|load|read_?param|get_?param)|on(?:_[a-z]|[A-Z])",
    re.IGNORECASE,
)
"""Functions that others call before the members are read, hooks of a framework among them."""
_NEAR = 40
_BEFORE_BASE = 200
_GIVEN = re.compile(rb"\s*(?:(?:[-+*/|&^%]|<<|>>)?=(?!=)|\+\+|--|\[|\{)")
_CONSTRUCTOR = re.compile(rb"(?:<\w+>)?\s*::\s*([^\s(]+)\s*\(")
"""Behind the name of a class: a constructor that is defined outside, if the name follows once more."""
_TAKEN = re.compile(rb"(?:>>|\+\+|--|(?<!&)&|(?<!if )(?<!while )(?<!return )[(,])\s*$")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each scalar member that all constructors, which are all in this file, leave out."""
    name = class_name(node, view)
    members = _members(node, name, view)
    if members is None or not members.constructors:
        return
    bodies = [(one.start_byte, one.end_byte) for one in members.constructors]
    for field, place in members.fields:
        if not any(True for start, end in bodies for _ in word_places(field.encode(), view, start, end)):
            is_read = (
                members.is_whole
                and not bases_of(node, view)
                and not _is_base(name, view)
                and _is_only_read(field, members.functions, view)
            )
            yield view.hit(
                "cpp.uninitialised_member",
                place,
                f"`{field}` has no value after construction; expected one where it is declared",
                certainty=None if is_read else Certainty.HEURISTIC,
            )


class _Members(NamedTuple):
    """What a class is made of.

    Attributes:
        constructors: definitions of all of them but those that copy or are the compiler's.
        fields: scalar ones without a value, each with its place.
        functions: bodies of functions that are defined inside.
        is_whole: whether all functions are.
    """

    constructors: list[Node]
    fields: list[tuple[str, Node]]
    functions: list[Node]
    is_whole: bool


def _members(node: Node, name: str, view: FileView) -> _Members | None:
    """Return the members of a class; None where a member may be set by what is not seen."""
    constructors: list[Node] = []
    fields: list[tuple[str, Node]] = []
    bodies: list[Node | None] = []
    for member in members_of(node, view):
        if member.declarator is None:
            fields.extend(_scalars(member.node, view))
            continue
        if _SECOND_STEP.match(member.name):
            return None
        if member.is_deleted or member.is_defaulted:
            continue
        bodies.append(member.node.child_by_field_name("body"))
        if member.name == name and not _is_copy(member.declarator, name, view):
            constructor = _constructor(member.node, member.declarator, name, view)
            if constructor is None:
                return None
            constructors.append(constructor)
    functions = [body for body in bodies if body is not None]
    return _Members(constructors, fields, functions, is_whole=len(functions) == len(bodies))


def _constructor(declared: Node, declarator: Node, name: str, view: FileView) -> Node | None:
    """Return the definition of a constructor; None where it is elsewhere, or leaves the work to others."""
    body = declared.child_by_field_name("body")
    if body is None:
        body = _outside(name, len(parameters_of(declarator)), view)
    return None if body is None or _calls(body, view) else body.parent


def _is_base(name: str, view: FileView) -> bool:
    """Return whether another class of the file is derived from it: its constructor may give the values."""
    for at in word_places(name.encode(), view):
        before = view.code[max(at - _BEFORE_BASE, 0) : at]
        if before[-1:].isspace() and before.rstrip().endswith((b"public", b"protected", b"private", b":")):
            return True
    return False


def _is_only_read(field: str, functions: list[Node], view: FileView) -> bool:
    """Return whether functions of the class use a member, and none gives it a value or hands it over."""
    word = field.encode()
    places = [at for one in functions for at in word_places(word, view, one.start_byte, one.end_byte)]
    for at in places:
        before, behind = view.code[max(0, at - _NEAR) : at], view.code[at + len(word) : at + len(word) + _NEAR]
        if _GIVEN.match(behind) or _TAKEN.search(before):
            return False
    return bool(places)


def _scalars(declaration: Node, view: FileView) -> Iterator[tuple[str, Node]]:
    if declaration.type != "field_declaration" or any(
        one.type == "storage_class_specifier" for one in declaration.children
    ):
        return
    if declaration.child_by_field_name("default_value") is not None or any(
        one.type == "bitfield_clause" for one in declaration.children
    ):
        return
    kind = declaration.child_by_field_name("type")
    is_scalar = kind is not None and kind.type in ("primitive_type", "sized_type_specifier")
    text = view.code[declaration.start_byte : declaration.end_byte]
    if b"=" in text or b"{" in text or b"(" in text:
        return
    for one in declaration.children_by_field_name("declarator"):
        if (is_scalar and one.type == "field_identifier") or one.type == "pointer_declarator":
            yield view.text(name_node(one)), one


def _calls(body: Node, view: FileView) -> bool:
    """Return whether the body calls what may set members."""
    for one in below(body, "call_expression", inside=("lambda_expression",)):
        function = one.child_by_field_name("function")
        if (
            function is None
            or function.type in ("identifier", "template_function")
            or view.text(function).startswith("this->")
        ):
            return True
        arguments = one.child_by_field_name("arguments")
        if arguments is not None and ("this" in view.text(arguments) or "&" in view.text(arguments)):
            return True
    return (
        b"memset" in view.code[body.start_byte : body.end_byte]
        or b"*this" in view.code[body.start_byte : body.end_byte]
    )


def _is_copy(declarator: Node, name: str, view: FileView) -> bool:
    parameters = parameters_of(declarator)
    if len(parameters) != 1:
        return False
    return view.text(parameters[0].child_by_field_name("type")).partition("<")[0].rpartition("::")[2] == name


def _outside(name: str, count: int, view: FileView) -> Node | None:
    """Return the body of the constructor with so many parameters that is defined outside of its class."""
    word = name.encode()
    if not name or b"::" not in view.code:
        return None
    for start in word_places(word, view):
        match = _CONSTRUCTOR.match(view.code, start + len(word))
        if match is None or match[1] != word:
            continue
        at = view.node_at(start, match.end())
        function = at if at is None or at.type == "function_definition" else above(at, "function_definition")
        declarator = function_declarator(function) if function is not None else None
        if function is not None and declarator is not None and len(parameters_of(declarator)) == count:
            return function.child_by_field_name("body")
    return None


RULE = FileRule(
    id="cpp.uninitialised_member",
    title="Member without a value",
    finds="A member of a number, `bool` or pointer type without a value, that none of the constructors in the "
    "file mentions; classes whose constructors call functions of their own, or that have a second step "
    "such as `configure` or `init`, are let be. Give it a value where it is declared. It is a note unless all "
    "functions of the class are seen, one of them reads it, and none sets it.",
    why="A limit or a flag begins with what was in memory: the robot behaves differently after each start.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "ros2",
        "ros1",
        "hicpp",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "hicpp 12.4.2",
        "autosar-cpp14 A12-1-1",
        "jsf-av 71",
        "paper2016 uninitMemberVar",
        "clang-tidy cppcoreguidelines-pro-type-member-init",
    ),
    bad="class A { public: A() : a_(3) {} private: int a_; bool on_; };\n",
    good="class A { public: A() : a_(3) {} private: int a_; bool on_ = false; };\n",
    syntax="cpp",
    kinds=("class_specifier", "struct_specifier"),
    spares_tests=True,
    found=found,
)
