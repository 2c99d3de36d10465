"""Rule ``cpp.c_style_cast``: a cast that does whatever makes it compile."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each cast."""
    if view.text(node.child_by_field_name("type")) != "void" and not node.has_error:
        yield view.hit(
            "cpp.c_style_cast",
            node,
            f"`{view.short(node)}` is a cast of C; expected `static_cast<…>` or another one with a name",
        )


RULE = FileRule(
    id="cpp.c_style_cast",
    title="Cast in the form of C",
    finds="`(T)x` may be a static, a const and a reinterpreting cast at once. Write the one that is meant; "
    "`(void)x` is let be.",
    why="A change of type somewhere else turns it into one that reads memory as something else, without a warning.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
        "safety",
        "paper2016",
    ),
    clauses=(
        "cpplint readability/casting",
        "hicpp 5.4.1",
        "misra-cpp-2008 5-2-4",
        "misra-cpp-2023 8.2.2",
        "autosar-cpp14 A5-2-2",
        "jsf-av 185",
        "paper2016 deprecated_casting",
        "clang-tidy google-readability-casting",
    ),
    bad="int f(double x) { return (int)x; }\n",
    good="int f(double x) { return static_cast<int>(x); }\n",
    syntax="cpp",
    kinds=("cast_expression",),
    in_c=False,
    found=found,
)
