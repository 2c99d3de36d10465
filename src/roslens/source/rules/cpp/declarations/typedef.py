"""Rule ``cpp.typedef``: a name for a type."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield each typedef."""
    yield view.hit("cpp.typedef", node, f"`{view.text(node)[:60]}`; expected `using`")


RULE = FileRule(
    id="cpp.typedef",
    title="`typedef`",
    finds="`typedef`. Write `using Name = …;`.",
    why="AUTOSAR asks for it: `using` takes templates, and reads from left to right.",
    severity=Severity.NOTE,
    profiles=("autosar-cpp14",),
    clauses=(
        "autosar-cpp14 A7-1-6",
        "clang-tidy modernize-use-using",
    ),
    bad="typedef int Count;\n",
    good="using Count = int;\n",
    syntax="cpp",
    kinds=("type_definition",),
    in_c=False,
    found=found,
)
