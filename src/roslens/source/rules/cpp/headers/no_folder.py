"""Rule ``cpp.no_folder``: a header without its folder."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_BARE = re.compile(rb"#[ \t]*include[ \t]*\"([^/\"\n]+\.(?:h|hpp|hh|hxx))\"")


def found_among(nodes: Sequence[Node], view: FileView) -> Iterator[Hit]:
    """Yield each include in quotes without a slash."""
    for node in nodes:
        match = _BARE.match(view.source, node.start_byte, node.end_byte)
        if match:
            name = match[1].decode("utf-8", "replace")
            yield view.hit_at(
                "cpp.no_folder",
                view.place(node.start_byte)[0],
                f'`"{name}"` without its folder; expected `"package/{name}"`',
            )


RULE = FileRule(
    id="cpp.no_folder",
    title="Include without the folder",
    finds='`#include "driver.h"` without a folder. Write `"package/driver.h"`.',
    why="Two packages have a `utils.h`, and the order of include folders picks one.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "ros-style",
        "paper2016",
    ),
    clauses=(
        "cpplint build/include_subdir",
        "paper2016 dir_in_header",
    ),
    bad='#include "driver.h"\n',
    good='#include "robot/driver.h"\n',
    syntax="cpp",
    kinds=("preproc_include",),
    found_among=found_among,
)
