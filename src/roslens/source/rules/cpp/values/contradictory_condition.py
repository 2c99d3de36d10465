"""Rule ``cpp.contradictory_condition``: a condition that is never true, or always, by its own numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.calls import number_of
from roslens.source.rules.cpp_statement import plain
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_AND, _OR = ("&&",), ("||",)
_COMPARES = re.compile(rb"[<>=!]=?\s*-?[\d.]|[\d.)]\s*[<>=!]")
_MIRRORED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "==", "!=": "!="}
_PURE = re.compile(r"(?:\w|->|\.|::|\[\w+\]|\(\))+")
_CALLED = re.compile(r"\b(?:size|length|x|y|z|w|norm|seconds|nanoseconds|count)\(\)")
_CONSTANT = re.compile(r"(?:\w+::)*(?:[A-Z][A-Z0-9_]+|k[A-Z]\w*)|(?:\w+::)+\w+")


class _Compared(NamedTuple):
    of: str
    sign: str
    value: float
    text: str


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each chain of ``&&`` or ``||`` of comparisons that contradict each other, or cover everything."""
    code = view.code
    for node in nodes:
        start, end = node.byte_range
        text = code[start:end]
        # Most are no chains: to look at the text costs less than to look at a node.
        if (b"&&" not in text and b"||" not in text) or not _COMPARES.search(text):
            continue
        sign = node.children[1] if node.child_count > 1 else None
        if sign is None or sign.type not in (*_AND, *_OR):
            continue
        around = node.parent
        if around is not None and around.type == "binary_expression" and around.children[1].type == sign.type:
            continue
        yield from _found(node, sign.type, view)


def _found(node: Node, sign: str, view: FileView) -> Iterator[Hit]:
    compared = [one for each in _operands(node, sign) if (one := _comparison(each, view)) is not None]
    for place, one in enumerate(compared):
        for other in compared[place + 1 :]:
            if one.of != other.of:
                continue
            if sign in _AND and _excludes(one, other):
                problem = "never true"
            elif sign in _OR and _covers(one, other):
                problem = "always true"
            else:
                continue
            yield view.hit(
                "cpp.contradictory_condition",
                node,
                f"`{one.text}` {sign} `{other.text}` is {problem}; expected another bound, or the other operator",
            )
            return


def _operands(node: Node, sign: str) -> Iterator[Node]:
    waiting = [node]
    while waiting:
        one = waiting.pop()
        inner = plain(one)
        if inner is not None and inner.type == "binary_expression" and inner.children[1].type == sign:
            waiting += [
                each for each in (inner.child_by_field_name("right"), inner.child_by_field_name("left")) if each
            ]
        elif inner is not None:
            yield inner


def _comparison(node: Node, view: FileView) -> _Compared | None:
    if node.type != "binary_expression":
        return None
    left, right = plain(node.child_by_field_name("left")), plain(node.child_by_field_name("right"))
    sign = view.text(node.child_by_field_name("operator"))
    if left is None or right is None or sign not in _MIRRORED:
        return None
    value, of = _value(right, view), view.text(left)
    if value is None:
        value, of, sign = _value(left, view), view.text(right), _MIRRORED[sign]
    if value is None or _PURE.fullmatch(of) is None or of[0].isdigit() or _CONSTANT.fullmatch(of):
        return None
    if "(" in _CALLED.sub("", of):
        # What is called twice may give two values.
        return None
    return _Compared(of, sign, value, view.text(node))


def _value(node: Node, view: FileView) -> float | None:
    """Return the value of a literal number."""
    number = number_of(node, view)
    return None if number is None or math.isnan(number) else number


def _excludes(one: _Compared, other: _Compared) -> bool:
    """Return whether nothing is both."""
    low, high = sorted((one, other), key=_order)
    if "!=" in (one.sign, other.sign):
        return False
    if one.sign == other.sign == "==":
        return one.value != other.value
    if low.sign in ("<", "<=") and high.sign in (">", ">=", "=="):
        return low.value < high.value or (low.value == high.value and not (_closed(low) and _closed(high)))
    if high.sign in (">", ">=") and low.sign == "==":
        return low.value < high.value or (low.value == high.value and high.sign == ">")
    return False


def _covers(one: _Compared, other: _Compared) -> bool:
    """Return whether everything is one of both."""
    if one.sign == other.sign == "!=":
        return one.value != other.value
    ups = [each for each in (one, other) if each.sign in (">", ">=")]
    downs = [each for each in (one, other) if each.sign in ("<", "<=")]
    if len(ups) != 1 or len(downs) != 1:
        return False
    up, down = ups[0], downs[0]
    return up.value < down.value or (up.value == down.value and (_closed(up) or _closed(down)))


def _order(one: _Compared) -> tuple[float, int]:
    return (one.value, 0 if one.sign in ("<", "<=") else 1)


def _closed(one: _Compared) -> bool:
    return one.sign in ("<=", ">=", "==")


RULE = FileRule(
    id="cpp.contradictory_condition",
    title="Condition that is never true, or always",
    finds="Comparisons of one value with literal numbers, joined by `&&` so that no number satisfies them, or by `||` "
    "so that every number does: `y > 1.8 && y < 1.8`, `state != 1 || state != 2`.",
    why="The branch never runs, or the check lets everything pass: a limit that was written down and does not hold.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("conditions",),
    clauses=("clang-tidy misc-redundant-expression", "cppcheck incorrectLogicOperator"),
    bad="bool f(double y) { return y > 1.8 && y < 1.8; }\n",
    good="bool f(double y) { return y > 1.8 || y < -1.8; }\n",
    syntax="cpp",
    kinds=("binary_expression",),
    found_among=found_among,
)
