"""Rule ``cpp.check_comparison``: a check that does not say what it compared."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.cpp_statement import arguments_of, free_call
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_NAMES = {"==": "EQ", "!=": "NE", "<": "LT", "<=": "LE", ">": "GT", ">=": "GE"}


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each check whose only argument is a comparison."""
    call = free_call(node, view)
    arguments = arguments_of(call) if call is not None else []
    if call is None or len(arguments) != 1 or arguments[0].type != "binary_expression":
        return
    operator = view.text(arguments[0].child_by_field_name("operator"))
    if operator in _NAMES:
        better = view.text(node).removesuffix("_TRUE") + "_" + _NAMES[operator]
        yield view.hit(
            "cpp.check_comparison",
            call,
            f"`{view.short(call)}` does not show the two values; expected `{better}(…, …)`",
        )


RULE = FileRule(
    id="cpp.check_comparison",
    title="Check of a comparison as one expression",
    finds="`CHECK(a == b)`, `EXPECT_TRUE(a == b)` and their like only say that it is false. Write `CHECK_EQ(a, "
    "b)`, `EXPECT_EQ(a, b)`.",
    why="The log of a test that failed on the robot does not hold the two values.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/check",
        "paper2016 check_eq",
    ),
    bad="void f(int a) { EXPECT_TRUE(a == 3); }\n",
    good="void f(int a) { EXPECT_EQ(a, 3); }\n",
    syntax="cpp",
    anchors=("CHECK", "DCHECK", "EXPECT_TRUE", "ASSERT_TRUE"),
    found=found,
)
