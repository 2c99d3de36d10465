"""Rule ``node.parameter_overwritten``: two parameters that are read into one variable."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import arguments, call_at, statement_around
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_MOST_AFTER = 40
"""Statements of the block that are looked at behind the first one."""
_READS = ("getParam", "param", "get_parameter", "get_parameter_or", "getParamCached")
_PLACE = re.compile(r"(?:this->)?[A-Za-z_]\w*(?:(?:\.|->)\w+|\[\w+\])*")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a read of a parameter whose value the next read of another one into the same variable takes away."""
    read = _read(node, view)
    if read is None:
        return
    statement, name, place = read
    word = re.compile(rb"(?<![\w.>])" + re.escape(place.encode()) + rb"(?!\w)")
    after = statement.next_named_sibling
    for _ in range(_MOST_AFTER):
        if after is None or after.type != "expression_statement":
            return
        if word.search(view.code, after.start_byte, after.end_byte):
            break
        after = after.next_named_sibling
    else:
        return
    again = _read_of(after, view)
    if again is None or again[2] != place or again[1] == name:
        return
    # The value of the first is the default of the second: of an old name, say.
    if len(word.findall(view.code, after.start_byte, after.end_byte)) != 1:
        return
    line = statement.start_point[0] + 1
    yield view.hit(
        "node.parameter_overwritten",
        after,
        f"{again[1]} is read into `{place}`, which has the value of {name} from line {line}; expected a variable of "
        "its own",
    )


def _read_of(statement: Node, view: FileView) -> tuple[Node, str, str] | None:
    """Return what a statement reads; None where it reads no parameter, or does something besides."""
    for one in _READS:
        at = re.search(rb"\b%s\b" % one.encode(), view.code[statement.start_byte : statement.end_byte])
        if at is not None:
            start = statement.start_byte + at.start()
            node = view.node_at(start, statement.start_byte + at.end())
            read = _read(node, view) if node is not None else None
            if read is not None and read[0] == statement:
                return read
    return None


def _read(node: Node, view: FileView) -> tuple[Node, str, str] | None:
    """Return the statement that reads a parameter, the name as written, and the variable that gets the value."""
    call = call_at(node)
    given = arguments(call) if call is not None else ()
    if call is None or not given or given[0].type not in ("string_literal", "binary_expression"):
        return None
    statement = statement_around(call)
    inner = statement.named_children[0] if statement.type == "expression_statement" else None
    if inner is None:
        return None
    if inner == call and len(given) > 1:
        place = view.text(given[1])
    elif inner.type == "assignment_expression" and view.text(inner.child_by_field_name("operator")) == "=":
        value = inner.child_by_field_name("right")
        if value is None or not _is_value_of(call, value):
            return None
        place = view.text(inner.child_by_field_name("left"))
    else:
        return None
    name = " ".join(view.text(given[0]).split())
    return (statement, name, place) if _PLACE.fullmatch(place) else None


def _is_value_of(call: Node, value: Node) -> bool:
    """Return whether an expression is the value of a parameter that a call reads, and nothing else."""
    inner: Node | None = value
    while inner is not None and inner != call:
        if inner.type == "call_expression":
            inner = inner.child_by_field_name("function") if not arguments(inner) else None
        elif inner.type in ("field_expression", "template_method"):
            inner = inner.child_by_field_name("argument") or inner.child_by_field_name("name")
        else:
            return False
    return inner is not None


RULE = FileRule(
    id="node.parameter_overwritten",
    title="Two parameters in one variable",
    finds="Two reads of parameters of different names into one variable, in one block, with no use of it between "
    "them. Read the second into its own variable. Where the second has the variable as its default, the first is an "
    "old name, and is left out.",
    why="The first parameter has no effect, and the variable that the second is meant for keeps what it was: a limit "
    "that nobody set.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("parameters",),
    bad='#include <ros/ros.h>\nvoid f() { nh.getParam("min", low); nh.getParam("max", low); }\n',
    good='#include <ros/ros.h>\nvoid f() { nh.getParam("min", low); nh.getParam("max", high); }\n',
    syntax="cpp",
    anchors=_READS,
    mentions=ROS_CPP,
    found=found,
)
