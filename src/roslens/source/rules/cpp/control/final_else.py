"""Rule ``cpp.final_else``: a chain that leaves a case out."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield the last link of a chain that has no else."""
    if node.child_by_field_name("alternative") is None:
        condition = view.text(node.child_by_field_name("condition"))
        yield view.hit_at(
            "cpp.final_else",
            view.place(node.start_byte)[0],
            f"`else if {shortened(condition, 50)}` is the end of its chain; expected an `else`",
        )


RULE = FileRule(
    id="cpp.final_else",
    title="`else if` without a final `else`",
    finds="A chain of `if … else if` that does not end in `else`. Add one, with a comment where nothing is to be done.",
    why="An unforeseen state is ignored silently.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 6-4-2",
        "misra-cpp-2023 9.4.1",
        "autosar-cpp14 M6-4-2",
        "jsf-av 192",
        "hicpp 6.1.2",
    ),
    bad="void f(int a) { if (a == 1) { g(); } else if (a == 2) { h(); } }\n",
    good="void f(int a) { if (a == 1) { g(); } else if (a == 2) { h(); } else { k(); } }\n",
    syntax="cpp",
    kinds=("(else_clause (if_statement) @node)",),
    found=found,
)
