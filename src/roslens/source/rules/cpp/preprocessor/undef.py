"""Rule ``cpp.undef``: a macro that is taken back."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such directive."""
    if view.text(node).startswith("#undef") or node.type == "preproc_directive":
        yield view.hit_at(
            "cpp.undef", view.place(node.start_byte)[0], "`#undef`; expected a name of its own for the macro"
        )


RULE = FileRule(
    id="cpp.undef",
    title="`#undef`",
    finds="`#undef`. Give the macro a name of its own instead.",
    why="What a name means depends on the line.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
    ),
    clauses=(
        "misra-cpp-2008 16-0-3",
        "misra-cpp-2023 19.0.4",
    ),
    bad="#undef RATE\n",
    good="#define ROBOT_RATE 10\n",
    syntax="cpp",
    anchors=("#undef",),
    found=found,
)
