"""Rule ``cpp.int8_limit``: a signed byte is compared with a number that it never has."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_flow.variable_type import local_declaration, type_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_COMPARING = frozenset({"==", "!=", "<", ">", "<=", ">="})
_SIGNED = re.compile(r"(?:std::|::)?int8_t|signed char")
_GRID = re.compile(r"\bOccupancyGrid(?:(?:::\w*)?(?:Const)?(?:Shared)?Ptr)?\b")
_CELL = re.compile(r"(\w+)(?:->|\.)data(?:\[|\.at\()")
_LEAST, _MOST = -128, 127
_COSTS = {"LETHAL_OBSTACLE": 254, "INSCRIBED_INFLATED_OBSTACLE": 253, "NO_INFORMATION": 255}
"""Values of costmap_2d and nav2_costmap_2d (``cost_values.hpp``)."""
_COST = re.compile(r"(?:::)?(?:nav2_)?costmap_2d::(\w+)")


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a comparison of a variable, or of a cell of an occupancy grid, with a literal beyond a signed byte."""
    if view.text(node.child_by_field_name("operator")) not in _COMPARING:
        return
    left, number = node.child_by_field_name("left"), _number(node.child_by_field_name("right"), view)
    if left is None or number is None or _LEAST <= number <= _MOST:
        return
    if _is_signed(left, view) or _is_cell(left, view):
        meant = "; unknown cells of a grid are -1, occupied ones 100" if _is_cell(left, view) else ""
        yield view.hit(
            "cpp.int8_limit",
            node,
            f"`{view.short(node)}` is the same for every value: a signed byte is {_LEAST} to {_MOST}; expected such a "
            f"number, or `uint8_t`{meant}",
        )


def _number(node: Node | None, view: FileView) -> int | None:
    if node is None:
        return None
    text = view.text(node)
    if cost := _COST.fullmatch(text):
        return _COSTS.get(cost[1])
    try:
        return int(text.rstrip("uUlL"), 0) if node.type == "number_literal" else None
    except ValueError:
        return None


def _is_signed(node: Node, view: FileView) -> bool:
    if node.type != "identifier":
        return False
    return _SIGNED.fullmatch(type_of(view.text(node), node, view)) is not None


def _is_cell(node: Node, view: FileView) -> bool:
    """Return whether an expression is a cell of what is declared as an occupancy grid."""
    cell = _CELL.match(view.text(node)) if node.type in ("subscript_expression", "call_expression") else None
    if cell is None:
        return False
    declared = local_declaration(cell[1], node, view)
    text = view.text(declared.child_by_field_name("type")) if declared is not None else type_of(cell[1], node, view)
    return _GRID.search(text) is not None and "Costmap" not in text


RULE = FileRule(
    id="cpp.int8_limit",
    title="Signed byte compared with what it never is",
    finds="A variable of type `int8_t`, or a cell of a `nav_msgs` OccupancyGrid, that is compared with a number beyond "
    "-128 to 127, such as 254 of a costmap.",
    why="The comparison has one result for every map: obstacles are taken for free space, or nothing is ever reached.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("values",),
    clauses=("gcc -Wtype-limits",),
    bad="bool f(const nav_msgs::msg::OccupancyGrid & map, int i) { return map.data[i] == 254; }\n",
    good="bool f(const nav_msgs::msg::OccupancyGrid & map, int i) { return map.data[i] == 100; }\n",
    syntax="cpp",
    kinds=(
        "(binary_expression right: (number_literal)) @node",
        "(binary_expression right: (qualified_identifier)) @node",
    ),
    mentions=("int8_t", "OccupancyGrid", "signed char"),
    found=found,
)
