"""A change of a file that mends a finding: which bytes become what, of which content."""

from __future__ import annotations

import msgspec

_MARK = b"\xef\xbb\xbf"


class Edit(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True, order=True):
    """Bytes of a file that become a text. The edits of one finding are made together or not at all.

    Attributes:
        path: of the file, below the workspace; empty while it is the file that was looked at.
        start: offset in bytes of the first one that is replaced, from 0.
        end: of the one behind the last; ``start`` where something is inserted.
        text: what stands there afterwards, with line feeds, whatever ends lines in the file.
        line: 1-based, of ``start``; ``end_line`` is that of ``end``.
        column: 1-based, of ``start``, in units of UTF-16, as editors and SARIF count; ``end_column`` is of ``end``.
        made_for: git's blob id of the content that the offsets are of.
    """

    path: str
    start: int
    end: int
    text: str
    line: int = 0
    column: int = 0
    end_line: int = 0
    end_column: int = 0
    made_for: str = ""


def edit_at(content: bytes, start: int, end: int, text: str, path: str = "") -> Edit:
    """Return the edit that puts ``text`` into the place of ``content[start:end]``."""
    place = place_of(content, start)
    return Edit(path, start, end, text, *place, *(place if end == start else place_of(content, end)))


def place_of(content: bytes, at: int) -> tuple[int, int]:
    """Return the line of a byte and its column in units of UTF-16, both 1-based; a byte order mark has no column."""
    before = content[content.rfind(b"\n", 0, at) + 1 : at]
    if not before.isascii():
        text = before.removeprefix(_MARK).decode("utf-8", "replace")
        return content.count(b"\n", 0, at) + 1, len(text.encode("utf-16-le")) // 2 + 1
    return content.count(b"\n", 0, at) + 1, len(before) + 1
