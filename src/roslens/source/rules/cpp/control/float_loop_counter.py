"""Rule ``cpp.float_loop_counter``: a loop that counts in fractions."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each loop whose counter is a floating-point number."""
    start = node.child_by_field_name("initializer")
    if start is not None and start.type == "declaration" and node.child_by_field_name("condition") is not None:
        kind = view.text(start.child_by_field_name("type"))
        if kind in ("float", "double"):
            yield view.hit(
                "cpp.float_loop_counter",
                start,
                f"`{view.short(start)}` counts in {kind}; expected an integer",
            )


RULE = FileRule(
    id="cpp.float_loop_counter",
    title="Loop counted in floating point",
    finds="A `for` whose counter is `float` or `double`. Count in integers, and compute the value.",
    why="`for (double a = 0; a < 1; a += 0.1)` runs ten times or eleven.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 6-5-1",
        "autosar-cpp14 A6-5-2",
        "jsf-av 197",
        "clang-tidy cert-flp30-c",
    ),
    bad="void f() { for (double a = 0; a < 1; a += 0.1) g(a); }\n",
    good="void f() { for (int i = 0; i < 10; ++i) g(0.1 * i); }\n",
    syntax="cpp",
    kinds=("for_statement",),
    found=found,
)
