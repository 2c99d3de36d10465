"""Rule ``cpp.storage_order``: a storage class behind the type."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LATE = re.compile(
    rb"\b(?:auto|char|short|int|long|float|double|bool|void|signed|unsigned)[ \t]+(static|extern|typedef|register)\b"
)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each storage class behind a type."""
    for match, node in places(_LATE, view, 1):
        text = match[0].decode("utf-8", "replace")
        yield view.hit("cpp.storage_order", node, f"`{text}`; expected `{match[1].decode()}` first")


RULE = FileRule(
    id="cpp.storage_order",
    title="Storage class behind the type",
    finds="`int static x`: storage classes stand first.",
    why="It reads as if the type were another one.",
    severity=Severity.NOTE,
    profiles=(
        "google",
        "hicpp",
        "paper2016",
    ),
    clauses=(
        "cpplint build/storage_class",
        "hicpp 7.1.3",
        "paper2016 storage_before_type",
    ),
    bad="int static counter;\n",
    good="static int counter;\n",
    syntax="cpp",
    whole=True,
    found=found,
)
