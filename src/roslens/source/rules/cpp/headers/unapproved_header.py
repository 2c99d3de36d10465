"""Rule ``cpp.unapproved_header``: a header that the guide forbids."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_HEADER = re.compile(rb"#[ \t]*include[ \t]*<(cfenv|fenv\.h|ratio|filesystem)>")


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each include of such a header."""
    for node in nodes:
        match = _HEADER.match(view.source, node.start_byte, node.end_byte)
        if match:
            yield view.hit_at(
                "cpp.unapproved_header",
                view.place(node.start_byte)[0],
                f"`<{match[1].decode()}>` is not allowed by the guide; expected none of it",
            )


RULE = FileRule(
    id="cpp.unapproved_header",
    title="Header that the Google guide forbids",
    finds="`<cfenv>`, `<fenv.h>`, `<ratio>` and `<filesystem>`, which the Google guide does not allow.",
    why="Only for those who follow the guide to the letter.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint build/c++11",
        "cpplint build/c++17",
        "paper2016 unapproved_headers",
    ),
    bad="#include <ratio>\n",
    good="#include <chrono>\n",
    syntax="cpp",
    kinds=("preproc_include",),
    found_among=found_among,
)
