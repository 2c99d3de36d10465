"""Rule ``cpp.forward_declaration``: a declaration of a name in another class."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import lines_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule

_DECLARED = (
    re.compile(rb"class[ \t]+\w+(?:::\w+)+[ \t]*;"),
    re.compile(rb"struct[ \t]+\w+(?:::\w+)+[ \t]*;"),
)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each forward declaration with a scope."""
    for match, line in (one for pattern in _DECLARED for one in lines_of(pattern, view)):
        text = match[0].decode("utf-8", "replace")
        if view.lines[line - 1].lstrip().startswith(match[0]):
            yield view.hit_at("cpp.forward_declaration", line, f"`{text}` declares nothing; expected an include")


RULE = FileRule(
    id="cpp.forward_declaration",
    title="Forward declaration inside of a class",
    finds="`class A::B;` declares nothing. Include the header of `A`.",
    why="With one compiler it compiles.",
    consequence=Consequence.MAY_BE_WRONG,
    certainty=Certainty.LIKELY,
    profiles=(
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint build/forward_decl",
        "paper2016 invalid_forward_declaration",
    ),
    bad="class A::B;\n",
    good="class B;\n",
    syntax="cpp",
    whole=True,
    words=("class", "struct"),
    found=found,
)
