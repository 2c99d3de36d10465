"""Rule ``node.nanosecond_duration``: seconds where nanoseconds are taken."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, number_of, whole_name
from roslens.source.rules.code_pattern import word_places
from roslens.source.rules.cpp_class import name_node
from roslens.source.rules.cpp_flow.declared_with import made_with
from roslens.source.rules.cpp_flow.member_facts import member_fact
from roslens.source.rules.cpp_flow.variable_type import class_around, type_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import RCLCPP, FileRule

_SHORTEST = 1000
"""Whoever means nanoseconds means more than a microsecond of them."""
_TYPE = "rclcpp::Duration"
_POINTERS = ("make_shared", "make_unique")
_IN_SECONDS = re.compile(r"(?:_|^)(?:s|secs?|seconds?)_?$|(?:[Ss]ec|[Ss]econds?)_?$")
_NUMBER = re.compile(r"(?:std::)?u?int\d*(?:_t)?|unsigned(?: int)?|(?:unsigned )?long(?: long)?|(?:std::)?size_t")
_NAME = re.compile(r"(?:this->)?\w+")
_ARGUMENTS = ("argument_list", "initializer_list")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a duration that is made of one small number, or of a variable in seconds."""
    if node.type == "field_initializer":
        yield from _of_other_header(node, view)
        return
    name = whole_name(node)
    if view.text(name) != _TYPE:
        return
    for given in _made(name, view):
        if _is_meant_as_seconds(given, view):
            yield _hit(given, view)


def _hit(given: Node, view: FileView, callback: str = "") -> Hit:
    text = view.text(given)
    return view.hit(
        "node.nanosecond_duration",
        given,
        f"`rclcpp::Duration({text})` takes {text} as nanoseconds; expected `rclcpp::Duration::from_seconds({text})`",
        callback=callback,
    )


def _of_other_header(initialiser: Node, view: FileView) -> Iterator[Hit]:
    """Yield what a member is made with that only another file declares, and that counts if it is a duration."""
    listed = arguments(initialiser.named_children[-1]) if initialiser.named_child_count > 1 else ()
    value = number_of(listed[0], view) if len(listed) == 1 else None
    member = view.text(initialiser.named_children[0])
    if value is None or not 0 < abs(value) < _SHORTEST or not member.isidentifier():
        return
    of_class = class_around(initialiser, view)
    if of_class and not type_of(f"this->{member}", initialiser, view):
        yield _hit(listed[0], view, member_fact(of_class, member, "Duration"))


def _is_meant_as_seconds(given: Node, view: FileView) -> bool:
    value = number_of(given, view)
    if value is not None:
        return 0 < abs(value) < _SHORTEST
    text = view.text(given)
    if _NAME.fullmatch(text) is None:
        return False
    kind = type_of(text, given, view)
    if kind in ("double", "float"):
        return True
    return _NUMBER.fullmatch(kind) is not None and _ends(text)


def _ends(name: str) -> bool:
    return _IN_SECONDS.search(name) is not None


def _made(name: Node, view: FileView) -> Iterator[Node]:
    """Yield the one argument that a duration gets: where it stands, in its pointer, as a member."""
    given = made_with(name)
    if given is not None and len(given) == 1:
        yield given[0]
        return
    around = name.parent
    if around is None:
        return
    if around.type == "field_declaration" and around.child_by_field_name("type") == name:
        yield from _of_member(around, view)
    elif around.type == "type_descriptor":
        call = above(name, "call_expression", "compound_statement")
        listed = arguments(call) if call is not None and call.type == "call_expression" else ()
        callee = view.text(call.child_by_field_name("function")) if call is not None else ""
        if (
            len(listed) == 1
            and callee.partition("<")[0].rpartition("::")[2] in _POINTERS
            and callee.endswith(f"<{_TYPE}>")
        ):
            yield listed[0]


def _of_member(declaration: Node, view: FileView) -> Iterator[Node]:
    """Yield what a member is made with where it is declared, and in the constructors of its class."""
    value = declaration.child_by_field_name("default_value")
    if value is not None:
        listed = arguments(value) if value.type in _ARGUMENTS else ()
        if len(listed) == 1:
            yield listed[0]
    member = view.text(name_node(declaration.child_by_field_name("declarator")))
    of_class = class_around(declaration, view)
    for at in word_places(member.encode(), view) if member.isidentifier() else ():
        word = view.node_at(at, at + len(member))
        initialiser = word.parent if word is not None else None
        if initialiser is None or initialiser.type != "field_initializer" or initialiser.named_children[0] != word:
            continue
        listed = arguments(initialiser.named_children[-1])
        if len(listed) == 1 and class_around(initialiser, view) == of_class:
            yield listed[0]


RULE = FileRule(
    id="node.nanosecond_duration",
    title="Duration in nanoseconds that looks like seconds",
    finds="`rclcpp::Duration` of one small number, or of a variable in seconds (of a floating-point type, or called "
    "so), which is nanoseconds; also where a member is made so. Use `rclcpp::Duration::from_seconds`, or two "
    "arguments.",
    why="Ported from ROS 1, where the number is seconds: the timeout is over at once, the buffer keeps nothing. Newer "
    "distributions refuse to build it.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("time",),
    bad="#include <rclcpp/rclcpp.hpp>\nauto limit = rclcpp::Duration(5);\n",
    good="#include <rclcpp/rclcpp.hpp>\nauto limit = rclcpp::Duration::from_seconds(5);\n",
    syntax="cpp",
    anchors=("rclcpp::Duration",),
    kinds=("field_initializer",),
    mentions=RCLCPP,
    found=found,
)
