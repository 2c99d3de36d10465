"""Rule ``cpp.source_included``: a source file that is included."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_SOURCE = re.compile(rb"#[ \t]*include[ \t]*[<\"]([^>\"\n]+\.(?:cpp|cc|cxx|c))[>\"]")


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each include of a source file."""
    for node in nodes:
        match = _SOURCE.match(view.source, node.start_byte, node.end_byte)
        if match:
            name = match[1].decode("utf-8", "replace")
            if not re.search(r"impl|moc_|\.moc|_inl|template", name):
                yield view.hit_at(
                    "cpp.source_included",
                    view.place(node.start_byte)[0],
                    f"`{name}` is a source file; expected its header",
                )


RULE = FileRule(
    id="cpp.source_included",
    title="Source file included",
    finds="`#include` of a file that ends in `.cpp`, `.cc`, `.cxx` or `.c`. Include its header, and build the file.",
    why="The file is compiled twice, or never as it stands.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "jsf-av",
        "paper2016",
    ),
    clauses=(
        "cpplint build/include",
        "jsf-av 32",
        "paper2016 include_cpp",
        "clang-tidy bugprone-suspicious-include",
    ),
    bad='#include "driver.cpp"\n',
    good='#include "driver.h"\n',
    syntax="cpp",
    kinds=("preproc_include",),
    found_among=found_among,
)
