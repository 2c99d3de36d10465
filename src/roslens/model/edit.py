"""A change of a file that mends a finding: which bytes become what, of which content."""

from __future__ import annotations

import msgspec


class Edit(msgspec.Struct, frozen=True, array_like=True, omit_defaults=True, order=True):
    """Bytes of a file that become a text. The edits of one finding are made together or not at all.

    Attributes:
        path: of the file, below the workspace; empty while it is the file that was looked at.
        start: offset in bytes of the first one that is replaced, from 0.
        end: of the one behind the last; ``start`` where something is inserted.
        text: what stands there afterwards, with line feeds, whatever ends lines in the file.
        line: 1-based, of ``start``, as ``column`` (in bytes) is; ``end_line`` and ``end_column`` are of ``end``.
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
    line, column = _place(content, start)
    end_line, end_column = (line, column) if end == start else _place(content, end)
    return Edit(path, start, end, text, line, column, end_line, end_column)


def _place(content: bytes, at: int) -> tuple[int, int]:
    return content.count(b"\n", 0, at) + 1, at - content.rfind(b"\n", 0, at)
