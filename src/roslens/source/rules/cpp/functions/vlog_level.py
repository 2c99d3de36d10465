"""Rule ``cpp.vlog_level``: a level of a verbose log that is a name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import places
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_LEVEL = re.compile(rb"(VLOG)\s*\(\s*(?:INFO|ERROR|WARNING|DFATAL|FATAL)\b")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each such call."""
    for match, node in places(_LEVEL, view, 1):
        text = match[0].decode("utf-8", "replace")
        yield view.hit("cpp.vlog_level", node, f"`{text})`; expected `LOG`, or a number")


RULE = FileRule(
    id="cpp.vlog_level",
    title="Name as the level of `VLOG`",
    finds="`VLOG(INFO)`: verbose levels are numbers. Write `LOG(INFO)` or `VLOG(1)`.",
    why="The message is logged at an unintended level.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint runtime/vlog",
        "paper2016 logging_levels",
    ),
    bad="void f() { VLOG(INFO) << 3; }\n",
    good="void f() { VLOG(1) << 3; }\n",
    syntax="cpp",
    whole=True,
    words=("VLOG",),
    found=found,
)
