"""The includes of a file as lines that an edit can move, or put another one beside."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cached_property

import msgspec

_LINE = re.compile(
    rb"^[ \t]*(?:#[ \t]*(if\w*|endif|define|undef|pragma)\b|\xa3[\xa0\x89]*(include)\b)[^\n]*(?:\n|\Z)", re.MULTILINE
)
"""A directive in code whose comments are blanked, where the name of an include is one word with its ``#``."""
_NAME = re.compile(rb"[ \t]*#[ \t]*include[ \t]*([<\"][^>\"\n]+[>\"])")
_GUARD = re.compile(
    rb"\s*#[ \t]*(?:ifndef[ \t]+(\w+)|if[ \t]+!defined[ \t]*\(?[ \t]*(\w+))[^\n]*\n\s*#[ \t]*define[ \t]+(\w+)[^\n]*\n?"
)
_ONCE = re.compile(rb"#[ \t]*pragma[ \t]+once\b[^\n]*\n?")
_STANDARD = re.compile(r"<[a-z_0-9]+>")


class IncludeLine(msgspec.Struct, frozen=True):
    """An include.

    Attributes:
        start: of its line.
        end: of its line, behind what ends it.
        name: with quotes or angles.
        conditional: an ``#if`` is around it that is no guard.
    """

    start: int
    end: int
    name: str
    conditional: bool

    @property
    def is_standard(self) -> bool:
        """Whether it is written as headers of the C++ library are: ``<vector>``."""
        return _STANDARD.fullmatch(self.name) is not None


class IncludeLines(msgspec.Struct, frozen=True, dict=True):
    """The includes of a file in order.

    ``other`` are the places of ``#define``, ``#undef`` and ``#pragma`` besides those of a guard. ``top`` is where a
    first include may stand: behind the guard, or where the code begins.
    """

    lines: Sequence[IncludeLine]
    other: Sequence[int]
    top: int

    @cached_property
    def firm(self) -> Sequence[IncludeLine]:
        """Those that no condition is around."""
        return [one for one in self.lines if not one.conditional]


def include_lines(content: bytes, code: bytes) -> IncludeLines:
    """Return the includes of a file.

    Args:
        content: of the file.
        code: the same with comments blanked (:mod:`~roslens.source.syntax.comments`).
    """
    top, guarded = _top(code)
    depth = -1 if guarded else 0
    found: list[IncludeLine] = []
    other: list[int] = []
    for match in _LINE.finditer(code):
        if match[2]:
            name = _NAME.match(content, match.start())
            if name is not None:
                found.append(
                    IncludeLine(match.start(), match.end(), name[1].decode("utf-8", "replace"), conditional=depth > 0)
                )
        elif match[1].startswith(b"if"):
            depth += 1
        elif match[1] == b"endif":
            depth -= 1
        elif match.start() >= top:
            other.append(match.start())
    return IncludeLines(tuple(found), tuple(other), top)


def _top(code: bytes) -> tuple[int, bool]:
    """Return where a first include may stand, and whether a guard of three lines is around the code."""
    guard = _GUARD.match(code)
    if guard is not None and (guard[1] or guard[2]) == guard[3]:
        return guard.end(), True
    if (once := _ONCE.search(code)) is not None:
        return once.end(), False
    first = re.search(rb"\S", code)
    return (code.rfind(b"\n", 0, first.start()) + 1 if first else len(code)), False


def place_for_standard(content: bytes, lines: IncludeLines, header: str, *, own: str = "") -> tuple[int, str]:
    """Return where a header of the C++ library is best included, and the text that includes it there.

    It comes into the first group of such headers in the order of names, else behind the own header of the file, else
    before the first include.

    Args:
        content: of the file.
        lines: of it.
        header: name without angles.
        own: stem of the names of the file and its own header.
    """
    text = f"#include <{header}>\n"
    group = _first_group([one for one in lines.firm if one.is_standard])
    for one in group:
        if one.name.strip("<>") > header:
            return one.start, text
    if group:
        return group[-1].end, text
    if not lines.firm:
        return lines.top, f"\n{text}"
    first = lines.firm[0]
    if own and first.name.startswith('"') and first.name.strip('"').rpartition("/")[2].partition(".")[0] == own:
        blank = "" if content[first.end : first.end + 2].lstrip(b"\r")[:1] in (b"", b"\n") else "\n"
        return first.end, f"\n{text}{blank}"
    return above_comments(content, first.start), f"{text}\n"


def above_comments(content: bytes, start: int) -> int:
    """Return the beginning of a line, or of the comments of a line each that stand right above it and are about it.

    A comment that reaches up to where the file begins is about the file.
    """
    at = start
    while at:
        before = content.rfind(b"\n", 0, at - 1) + 1
        line = content[before:at].strip()
        if not line.startswith(b"//"):
            return at if not line else start
        at = before
    return start


def _first_group(standard: Sequence[IncludeLine]) -> Sequence[IncludeLine]:
    found: list[IncludeLine] = []
    for one in standard:
        if found and one.start != found[-1].end:
            break
        found.append(one)
    return found
