"""Rule ``cpp.const_cast``: a promise not to change something that is taken back."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView, above
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such cast."""
    call = above(node, "call_expression", "compound_statement")
    text = view.short(call) if call is not None and call.type == "call_expression" else "const_cast"
    if node.type != "preproc_arg":
        yield view.hit("cpp.const_cast", node, f"`{text}`; expected a type that is not const, or a copy")


RULE = FileRule(
    id="cpp.const_cast",
    title="`const_cast`",
    finds="`const_cast` takes `const` away: changing what was made constant is undefined. Fix the type instead.",
    why="Messages that are shared between subscribers of a process are const for a reason: one callback "
    "changes what another reads.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "misra-cpp-2008 5-2-5",
        "misra-cpp-2023 8.2.3",
        "autosar-cpp14 A5-2-3",
        "hicpp 5.4.1",
        "clang-tidy cppcoreguidelines-pro-type-const-cast",
    ),
    bad="int& f(const int& x) { return const_cast<int&>(x); }\n",
    good="int f(const int& x) { return x; }\n",
    syntax="cpp",
    anchors=("const_cast",),
    found=found,
)
