"""Rule ``cpp.include_after_code``: an include behind code."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each include of the file's own level that stands behind code."""
    has_code = False
    for node in view.root.children:
        if node.type == "preproc_include":
            if has_code:
                text = view.short(node)
                yield view.hit_at(
                    "cpp.include_after_code",
                    view.place(node.start_byte)[0],
                    f"`{text}` stands behind code; expected it at the top",
                )
        elif node.type != "comment" and not node.type.startswith(("preproc", "#", "\n", "ERROR", ";")):
            has_code = True


RULE = FileRule(
    id="cpp.include_after_code",
    title="Include behind code",
    finds="An `#include` behind a declaration, outside of `#if` and namespaces. Put it at the top.",
    why="What stands before it changes what it means.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "misra-cpp-2008",
        "misra-cpp-2023",
        "autosar-cpp14",
    ),
    clauses=(
        "misra-cpp-2008 16-0-1",
        "misra-cpp-2023 19.0.3",
        "autosar-cpp14 M16-0-1",
    ),
    bad="int a;\n#include <vector>\n",
    good="#include <vector>\nint a;\n",
    syntax="cpp",
    whole=True,
    found=found,
)
