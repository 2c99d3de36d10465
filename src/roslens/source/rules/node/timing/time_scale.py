"""Rule ``node.time_scale``: a time that is scaled away from the unit that was meant."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule

_NANOSECONDS = frozenset({"nanoseconds", "toNSec"})
_SECONDS = frozenset({"seconds", "toSec"})
_BILLION = 1e9


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a product or quotient of a time and a power of ten that gives a unit of no use."""
    call, name = _call_of(node), view.text(node)
    product = call.parent if call is not None else None
    while product is not None and product.type in ("parenthesized_expression", "cast_expression"):
        call, product = product, product.parent
    if product is None or product.type != "binary_expression" or product.child_by_field_name("left") != call:
        return
    operator = view.text(product.child_by_field_name("operator"))
    number = _number(product.child_by_field_name("right"), view)
    if operator not in ("*", "/") or not number:
        return
    factor = number if operator == "*" else 1 / number
    wrong = _BILLION if name in _NANOSECONDS else 1 / _BILLION
    if math.isclose(factor, wrong, rel_tol=1e-6):
        is_nano = name in _NANOSECONDS
        unit = "nanoseconds" if is_nano else "seconds"
        expected = f"`{name}() * 1e-9`, which are seconds" if is_nano else f"`{name}() * 1e9`, which are nanoseconds"
        yield view.hit(
            "node.time_scale",
            product,
            f"`{view.short(product)}` scales {unit} by {factor:g}, which is no unit of time; expected {expected}",
        )


def _call_of(name: Node) -> Node | None:
    """Return the call of a method without arguments by its name."""
    field = name.parent
    call = field.parent if field is not None and field.type == "field_expression" else None
    given = call.child_by_field_name("arguments") if call is not None and call.type == "call_expression" else None
    return call if given is not None and not given.named_children else None


def _number(node: Node | None, view: FileView) -> float:
    """Return the value of a literal; 0 for anything else."""
    if node is None or node.type != "number_literal":
        return 0.0
    try:
        return float(view.text(node).replace("'", "").rstrip("fFlLuU"))
    except ValueError:
        return 0.0


RULE = FileRule(
    id="node.time_scale",
    title="Time scaled by the inverse factor",
    finds="`nanoseconds() / 1e-9` or `* 1e9`, and `seconds() / 1e9` or `* 1e-9` (in ROS 1 `toNSec()` and `toSec()`): "
    "the factor between the two the wrong way round.",
    why="A period of 20 ms becomes 2e16: odometry, velocities and limits made of it are nonsense.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("time",),
    bad="#include <rclcpp/rclcpp.hpp>\nvoid f() { double dt = (now - last).nanoseconds() / 1e-9; }\n",
    good="#include <rclcpp/rclcpp.hpp>\nvoid f() { double dt = (now - last).nanoseconds() * 1e-9; }\n",
    syntax="cpp",
    anchors=("nanoseconds", "toNSec", "toSec", "seconds"),
    mentions=ROS_CPP,
    found=found,
)
