"""Rule ``cpp.commented_code``: code that is asleep."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_CODE = re.compile(rb"//[ \t]*(?![/!*@\\\\])[^\n]*[;{}][ \t\r]*\n[ \t]*//[^\n]*[;{}][ \t\r]*\n")


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each block of comments that reads like code."""
    if not view.mentions((b"//",)):
        return
    end = -1
    for match in _CODE.finditer(view.content):
        line, column = view.place(match.start())
        is_first, end = line > end + 1, line + 1
        if is_first and not view.lines[line - 1][: column - 1].strip() and (b"(" in match[0] or b"=" in match[0]):
            yield view.hit_at("cpp.commented_code", line, "code in comments; expected it to be deleted")


RULE = FileRule(
    id="cpp.commented_code",
    title="Code in comments",
    finds="Two or more lines of comments in a row that end like code. Delete them; the repository keeps them.",
    why="It is unclear whether it is meant to come back.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.HEURISTIC,
    profiles=(
        "hicpp",
        "misra-cpp-2008",
        "autosar-cpp14",
        "jsf-av",
    ),
    clauses=(
        "misra-cpp-2008 2-7-3",
        "autosar-cpp14 A2-7-2",
        "jsf-av 127",
        "hicpp 2.3.2",
    ),
    bad="// int a = 3;\n// f(a);\n",
    good="// The limit is three.\n",
    syntax="cpp",
    whole=True,
    found=found,
)
