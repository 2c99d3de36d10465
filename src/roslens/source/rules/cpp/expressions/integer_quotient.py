"""Rule ``cpp.integer_quotient``: a quotient of whole numbers whose fraction is lost in what has fractions."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_QUOTIENT = re.compile(rb"(?<![\w.])([1-9]\d*)\s*/\s*([1-9]\d*)(?![\w.])")
_FRACTION = re.compile(r"\d+\.\d*(?:[eE][+-]?\d+)?[fFlL]?|\.\d+[fFlL]?|M_PI\w*")
_REAL = re.compile(r"(?:(?:static|const|constexpr|inline)\s+)*(?:double|float|long double)(?:\s+const)?")
_MOST_LOST = 0.01
"""Of the quotient; less is rounding that may be meant."""


def found(root: Node, view: FileView) -> Iterator[Hit]:
    """Yield each quotient of two literals that is not whole, in an expression that has fractions."""
    for match in _QUOTIENT.finditer(view.code):
        node = root.descendant_for_byte_range(match.start(), match.end())
        if node is None or node.type != "binary_expression" or (node.start_byte, node.end_byte) != match.span():
            continue
        left, right = int(match[1]), int(match[2])
        if (left / right - left // right) > _MOST_LOST * left / right and _has_fractions(node, view):
            yield view.hit(
                "cpp.integer_quotient",
                node,
                f"`{view.text(node)}` is {left // right} in whole numbers, and what it is part of has fractions; "
                f"expected `{left}.0 / {right}`",
            )


def _has_fractions(node: Node, view: FileView) -> bool:
    """Return whether a quotient is a factor, a term or the value of something that has fractions."""
    inner: Node = node
    while (around := inner.parent) is not None:
        match around.type:
            case "parenthesized_expression":
                pass
            case "binary_expression" if view.text(around.child_by_field_name("operator")) in ("*", "+", "-", "/"):
                sides = (around.child_by_field_name("left"), around.child_by_field_name("right"))
                other = next((one for one in sides if one is not None and one != inner), None)
                if other is not None and _FRACTION.fullmatch(view.text(other)):
                    return True
            case "init_declarator":
                declared = around.parent
                return declared is not None and _is_real(declared, view)
            case "field_declaration":
                return _is_real(around, view)
            case "initializer_list":
                listed = around.parent
                if listed is None or listed.type not in ("init_declarator", "field_declaration"):
                    return False
            case _:
                return False
        inner = around
    return False


def _is_real(declaration: Node, view: FileView) -> bool:
    return _REAL.fullmatch(view.text(declaration.child_by_field_name("type"))) is not None


RULE = FileRule(
    id="cpp.integer_quotient",
    title="Quotient of whole numbers in what has fractions",
    finds="`3591 / 187` and the like as a factor or term beside a number with a decimal point, or as the value of a "
    "`double` or `float`, where a hundredth or more is lost. Write a decimal point.",
    why="The gear of 19.2 is one of 19, and `1 / 2` is nothing: speeds and distances are wrong by a factor that no "
    "test of one part shows.",
    consequence=Consequence.WRONG,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=(),
    clauses=("clang-tidy bugprone-integer-division",),
    bad="double ratio = 3591 / 187;\n",
    good="double ratio = 3591.0 / 187;\n",
    syntax="cpp",
    whole=True,
    found=found,
)
