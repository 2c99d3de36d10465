"""Rule ``cpp.null_pointer``: a null pointer that is a number."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.pointer_expected import is_pointer_expected
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each ``NULL``."""
    if view.text(node) == "NULL":
        edits = view.edits((node.start_byte, node.end_byte, "nullptr")) if is_pointer_expected(node, view) else ()
        yield view.hit("cpp.null_pointer", node, "`NULL`; expected `nullptr`", edits=edits)


RULE = FileRule(
    id="cpp.null_pointer",
    title="`NULL` for a null pointer",
    finds="`NULL` is a number. Write `nullptr`.",
    why="An overloaded function, or a template, gets an integer where a pointer was meant.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "hicpp",
        "misra-cpp-2023",
        "autosar-cpp14",
        "safety",
    ),
    clauses=(
        "hicpp 2.5.3",
        "misra-cpp-2023 7.11.1",
        "autosar-cpp14 A4-10-1",
        "clang-tidy modernize-use-nullptr",
    ),
    fix="Writes `nullptr` where the file shows that a pointer is expected: where one is declared, set, "
    "compared or returned, and for arguments such as those of `time`. Where a number may be meant, it is "
    "left.",
    bad="char* p = NULL;\n",
    good="char* p = nullptr;\n",
    syntax="cpp",
    anchors=("NULL",),
    in_c=False,
    found=found,
)
