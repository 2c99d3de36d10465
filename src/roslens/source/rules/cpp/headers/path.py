"""Rule ``cpp.path``: a path in an include."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_PATH = re.compile(rb"#[ \t]*include[ \t]*[<\"]((?:[^>\"\n]*(?:\.\./|\\\\)|/)[^>\"\n]*)[>\"]")


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each include that leaves its folder."""
    for node in nodes:
        match = _PATH.match(view.source, node.start_byte, node.end_byte)
        if match:
            name = match[1].decode("utf-8", "replace")
            yield view.hit_at(
                "cpp.path",
                view.place(node.start_byte)[0],
                f"`{name}` leaves its folder; expected the path below the include folder",
            )


RULE = FileRule(
    id="cpp.path",
    title="Path in an include",
    finds="`..`, a backslash or an absolute path in an `#include`. Include by the path below the include folder.",
    why="The header is found in this workspace only, not where the package is installed.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
    ),
    clauses=(
        "hicpp 16.1.2",
        "misra-cpp-2008 16-2-5",
    ),
    bad='#include "../driver.h"\n',
    good='#include "robot/driver.h"\n',
    syntax="cpp",
    kinds=("preproc_include",),
    found_among=found_among,
)
