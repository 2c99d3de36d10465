"""Rule ``cpp.included_twice``: a header that is included twice by one file."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.code_pattern import lines_of
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import FileRule
from roslens.source.rules.spans import line_around

_NAME = re.compile(rb"include[\xa0\x89]*([\xa2\xbc]\S+)")
_DEFINES = re.compile(rb"#[ \t]*(?:define|undef|pragma[ \t]+(?!once))")
_INCLUDE = re.compile(rb"^[ \t]*(?:#[ \t]*(if|endif)|\xa3[\xa0\x89]*include[\xa0\x89]*([^\s]+))", re.MULTILINE)


def found(_: Node, view: FileView) -> Iterator[Hit]:
    """Yield each include of what the file has included before, at the same level of ``#if``."""
    names = _NAME.findall(view.code)
    if len(set(names)) == len(names):
        return
    seen: dict[bytes, int] = {}
    depth = 0
    outermost = 1 if view.code.lstrip().startswith((b"#ifndef", b"#if !defined")) else 0
    for match, line in lines_of(_INCLUDE, view):
        if not match[2]:
            depth += 1 if match[1] == b"if" else -1
            continue
        before = seen.setdefault(match[2], line) if depth <= outermost else line
        if before != line and not match[2].endswith((b".inc\xbe", b".def\xa2")):
            text = " ".join(view.lines[line - 1].decode("utf-8", "replace").split())[:80]
            yield view.hit_at(
                "cpp.included_twice",
                line,
                f"`{text}` stands on line {before} too; expected it once",
                edits=_edits(match, before, view),
            )


def _edits(match: re.Match[bytes], before: int, view: FileView) -> tuple[Edit, ...]:
    """Return what takes a line away, unless what stands between the two may give it another meaning."""
    start, end = line_around(view.content, match.start(2))
    first = sum(map(len, view.lines[: before - 1])) + before - 1
    between = view.code[first:start]
    if _DEFINES.search(between) or b"/*" in view.content[start:end]:
        return ()
    return view.edits((start, end, ""))


RULE = FileRule(
    id="cpp.included_twice",
    title="Header included twice",
    finds="The same `#include` a second time in one file, outside of `#if`. Remove one.",
    why="It costs nothing but the time of a reader, who asks what is different the second time.",
    consequence=Consequence.STYLE,
    certainty=Certainty.PROVEN,
    profiles=(
        "ros2",
        "ros1",
        "google",
        "paper2016",
    ),
    clauses=(
        "cpplint build/include",
        "paper2016 include_twice",
        "clang-tidy readability-duplicate-include",
    ),
    fix="Takes the second one away, unless a macro is defined between the two.",
    bad="#include <string>\n#include <vector>\n#include <string>\n",
    good="#include <string>\n#include <vector>\n",
    syntax="cpp",
    whole=True,
    found=found,
)
