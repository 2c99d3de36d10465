"""Rule ``cpp.copyright``: a file that nobody owns."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_HEAD = 2500
_WORD = re.compile(rb"copyright|\(c\) \d{4}|SPDX-License", re.IGNORECASE)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield a file whose first lines do not name an owner."""
    # Most files say so in the usual way, which is found sooner than all ways.
    at = view.content.find(b"opyright", 1, _HEAD)
    if at > 0 and view.content[at - 1] in b"Cc":
        return
    if view.code.strip() and not _WORD.search(view.content, 0, _HEAD):
        yield view.hit_at(
            "cpp.copyright", 1, "no copyright in the first lines; expected whose the file is, and its licence"
        )


RULE = FileRule(
    id="cpp.copyright",
    title="No copyright",
    finds="A file without the word copyright in its first lines. Say whose it is and under which licence.",
    why="A file without a licence may not be used.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint legal/copyright",
        "paper2016 no_copyright",
    ),
    bad="int a;\n",
    good="// Copyright 2020 The authors\nint a;\n",
    syntax="cpp",
    whole=True,
    found=found,
)
