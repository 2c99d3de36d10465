"""Rule ``node.nanosecond_factor_python``: seconds and nanoseconds that a wrong power of ten turns into each other."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.callbacks import callee_name
from roslens.source.rules.calls import arguments, number_of
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.flow.python_functions import python_functions
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_PYTHON, FileRule

_TIMES = frozenset({"Time", "Duration"})
_NANOSECONDS = frozenset({"nanosec", "nsecs", "nanoseconds", "nsec"})
_SECONDS = frozenset({"sec", "secs", "seconds"})
_TRANSPARENT = frozenset({"int", "float", "round", "abs", "floor", "math.floor", "np.int32", "np.uint32"})
_WHOLES = frozenset({"int", "floor", "math.floor", "np.floor", "math.trunc"})
_OTHER_UNIT = re.compile(r"ms|milli|micro|us\b|nano", re.IGNORECASE)
_NAMED_SECONDS = re.compile(r"(?:^|[_.])(?:sec|secs|seconds)$", re.IGNORECASE)
_FACTOR = 1e9
_PARTS = ("binary_operator", "call", "argument_list", "parenthesized_expression")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a wrong factor in what is given as nanoseconds, or in what is made of them."""
    around = node.parent
    if around is None:
        return
    if around.type == "keyword_argument":
        call, value = above(around, "call"), around.child_by_field_name("value")
        is_time = call is not None and (view.text(node) != "nanoseconds" or callee_name(call, view) in _TIMES)
        if is_time and value is not None and value != node:
            yield from _of_nanoseconds(value, view)
    elif around.type == "attribute" and around.child_by_field_name("attribute") == node:
        yield from _of_attribute(around, view)


def _of_attribute(attribute: Node, view: FileView) -> Iterator[Hit]:
    """Yield what is wrong where an attribute that holds nanoseconds is set, or read."""
    around = attribute.parent
    if around is not None and around.type == "assignment" and around.child_by_field_name("left") == attribute:
        right = around.child_by_field_name("right")
        if right is not None:
            yield from _of_nanoseconds(right, view)
        return
    while around is not None and around.type in _PARTS and not _is_sum(around, view):
        around = around.parent
    if around is None:
        return
    left, right = around.child_by_field_name("left"), around.child_by_field_name("right")
    if around.type == "binary_operator":
        yield from _of_sum(around, view)
    elif around.type == "assignment" and left is not None and right is not None:
        name = view.text(left)
        if _NAMED_SECONDS.search(name) and not _OTHER_UNIT.search(name):
            yield from _of_seconds(right, left, view)


def _is_sum(node: Node, view: FileView) -> bool:
    return node.type == "binary_operator" and view.text(node.child_by_field_name("operator")) == "+"


def _of_nanoseconds(value: Node, view: FileView) -> Iterator[Hit]:
    """Yield a fraction of a second that is multiplied by another power of ten than 1e9."""
    for one in python_functions(view).values(value):
        product = _bare(one, view)
        factor, rest = _scaled(product, view)
        if factor in (1.0, _FACTOR) or not _is_power(factor) or not _is_fraction(rest, view):
            continue
        yield view.hit(
            "node.nanosecond_factor_python",
            product,
            f"`{view.short(product)}` is a fraction of a second times {factor:g}, given as nanoseconds; expected the "
            "factor 1e9",
        )


def _of_sum(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a sum of the seconds and nanoseconds of a time that have not one unit."""
    sides = [node.child_by_field_name(side) for side in ("left", "right")]
    parts = {}
    for side in sides:
        factor, rest = _scaled(side, view)
        name = view.text(rest).rpartition(".")[2]
        if rest is None or rest.type != "attribute":
            return
        if name in _SECONDS or name in _NANOSECONDS:
            parts["seconds" if name in _SECONDS else "nanoseconds"] = (factor, view.text(rest).rpartition(".")[0])
    if len(parts) != 2 or parts["seconds"][1] != parts["nanoseconds"][1] or not parts["nanoseconds"][0]:
        return
    ratio = parts["seconds"][0] / parts["nanoseconds"][0]
    if not math.isclose(ratio, _FACTOR, rel_tol=1e-6):
        yield view.hit(
            "node.nanosecond_factor_python",
            node,
            f"`{view.short(node)}` adds seconds and nanoseconds with the factor {ratio:g} between them; expected 1e9: "
            "`time.sec + time.nanosec * 1e-9`",
            certainty=None,
        )


def _of_seconds(value: Node, left: Node, view: FileView) -> Iterator[Hit]:
    """Yield nanoseconds that are given to a variable of seconds with another factor than 1e-9."""
    factor, rest = _scaled(_bare(value, view), view)
    is_nanoseconds = rest is not None and rest.type == "attribute" and view.text(rest).endswith(".nanoseconds")
    if is_nanoseconds and _is_power(factor) and not math.isclose(factor * _FACTOR, 1.0):
        yield view.hit(
            "node.nanosecond_factor_python",
            value,
            f"`{view.short(value)}` is not in seconds, as `{view.short(left)}` says; expected `nanoseconds / 1e9`",
        )


def _scaled(node: Node | None, view: FileView) -> tuple[float, Node | None]:
    """Return the factor by which an expression is multiplied, and what is multiplied."""
    factor = 1.0
    node = _bare(node, view) if node is not None else None
    while node is not None and node.type == "binary_operator":
        operator = view.text(node.child_by_field_name("operator"))
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        by, of = _constant(right, view), left
        if by is None and operator == "*":
            by, of = _constant(left, view), right
        if by is None or of is None or operator not in ("*", "/", "//") or not by:
            break
        factor = factor * by if operator == "*" else factor / by
        node = _bare(of, view)
    return factor, node


def _constant(node: Node | None, view: FileView) -> float | None:
    """Return the value of a number, or of a power or quotient of two."""
    if node is not None and node.type == "parenthesized_expression" and node.named_children:
        node = node.named_children[0]
    if node is None or node.type != "binary_operator":
        return number_of(node, view) if node is not None and node.type in ("integer", "float") else None
    left, right = (number_of(node.child_by_field_name(side), view) for side in ("left", "right"))
    operator = view.text(node.child_by_field_name("operator"))
    if left is None or right is None or abs(left) > _FACTOR * _FACTOR or abs(right) > _FACTOR * _FACTOR:
        return None
    if operator == "**":
        return left**right if left == 10 and abs(right) <= 18 else None
    return left / right if operator == "/" and right else None


def _bare(node: Node, view: FileView) -> Node:
    """Return what stands in parentheses and in conversions that leave the unit as it is."""
    while True:
        inner = None
        if node.type == "parenthesized_expression":
            inner = next(iter(node.named_children), None)
        elif node.type == "call" and view.text(node.child_by_field_name("function")) in _TRANSPARENT:
            inner = next(iter(arguments(node)), None)
        if inner is None:
            return node
        node = inner


def _is_power(factor: float) -> bool:
    return factor > 0 and math.isclose(math.log10(factor) % 1, 0, abs_tol=1e-9)


def _is_fraction(node: Node | None, view: FileView) -> bool:
    """Tell whether an expression is what is left of seconds beside the whole ones."""
    values = python_functions(view).values(node) if node is not None else ()
    return any(_is_remainder(_bare(one, view), view) for one in values)


def _is_remainder(node: Node, view: FileView) -> bool:
    text = view.text(node)
    if node.type == "subscript":
        return callee_name(node.child_by_field_name("value") or node, view) == "modf" and text.endswith("[0]")
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    if node.type != "binary_operator" or left is None or right is None or _OTHER_UNIT.search(text):
        return False
    operator = view.text(node.child_by_field_name("operator"))
    return number_of(right, view) == 1 if operator == "%" else operator == "-" and _is_whole_of(right, left, view)


def _is_whole_of(node: Node, of: Node, view: FileView) -> bool:
    """Tell whether an expression is the whole part of another."""
    for one in python_functions(view).values(node):
        if one.type == "call" and view.text(one.child_by_field_name("function")) in _WHOLES:
            inner = next(iter(arguments(one)), None)
            if inner is not None and view.text(inner) == view.text(of):
                return True
    return False


RULE = FileRule(
    id="node.nanosecond_factor_python",
    title="Wrong factor between seconds and nanoseconds (Python)",
    finds="A fraction of a second that is multiplied by another power of ten than 1e9 and given as nanoseconds, a sum "
    "of `sec` and `nanosec` of one time with another factor, and `nanoseconds` divided by another one for a variable "
    "that is called seconds.",
    why="Stamps and durations are wrong by a factor of a thousand in their fraction: transforms are looked up at the "
    "wrong time, and rates jump with each second.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="import rclpy\nstamp = Time(seconds=int(now), nanoseconds=int((now - int(now)) * 1e6))\n",
    good="import rclpy\nstamp = Time(seconds=int(now), nanoseconds=int((now - int(now)) * 1e9))\n",
    syntax="python",
    anchors=("nanosec", "nanoseconds", "nsecs"),
    mentions=ROS_PYTHON,
    found=found,
)
