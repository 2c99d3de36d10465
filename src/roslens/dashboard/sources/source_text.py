"""Files as lines to show: read once, checked against the run, cut into excerpts."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from hashlib import sha1

import msgspec

from roslens.dashboard.sources.colours import Piece, colour
from roslens.model.source import SourceFile

ReadSource = Callable[[str], bytes | None]
"""Gives the content of a file by its path below the workspace root; None where it cannot."""

AROUND = 2
LONGEST_LINE = 400
_KEPT = 256


class SourceText(msgspec.Struct, frozen=True):
    """The lines of a file. ``changed`` is whether it differs from what the run analysed."""

    lines: tuple[str, ...]
    changed: bool = False


class Excerpt(msgspec.Struct, frozen=True):
    """Coloured lines around a place: (number, whether it is flagged, pieces)."""

    lines: tuple[tuple[int, bool, tuple[Piece, ...]], ...]
    changed: bool = False


class Sources:
    """The sources of a run; the last few are kept, because findings come file by file."""

    def __init__(self, read: ReadSource, file_of: Callable[[str], SourceFile | None]) -> None:
        """``file_of`` gives what the run knows of a path."""
        self._read = read
        self._file_of = file_of
        self._kept: OrderedDict[str, SourceText | None] = OrderedDict()

    def text(self, path: str) -> SourceText | None:
        """Return the file; None where it cannot be read."""
        if path in self._kept:
            self._kept.move_to_end(path)
            return self._kept[path]
        content = self._read(path)
        file = self._file_of(path)
        text = None
        if content is not None:
            known = file.content_hash if file else ""
            text = SourceText(lines_of(content), bool(known) and known != blob_id(content))
        self._kept[path] = text
        if len(self._kept) > _KEPT:
            self._kept.popitem(last=False)
        return text

    def excerpt(self, path: str, line: int, end_line: int = 0, around: int = AROUND) -> Excerpt | None:
        """Return the lines around a finding, at most eight of a long one; None without a line or a file."""
        text = self.text(path) if path and line > 0 else None
        if text is None or line > len(text.lines):
            return None
        last = min(max(line, end_line), line + 7, len(text.lines))
        first, end = max(1, line - around), min(len(text.lines), last + around)
        coloured = colour(text.lines[first - 1 : end], self.language(path))
        return Excerpt(
            tuple((number, line <= number <= last, coloured[number - first]) for number in range(first, end + 1)),
            text.changed,
        )

    def language(self, path: str) -> str:
        """Return the language of a file as the run saw it."""
        file = self._file_of(path)
        return file.language.value if file else ""


def lines_of(content: bytes) -> tuple[str, ...]:
    """Return the lines as analysers count them: only a line feed ends one."""
    text = content.decode("utf-8", "replace").removeprefix("\N{ZERO WIDTH NO-BREAK SPACE}")
    lines = text.split("\n")
    if lines and not lines[-1]:
        lines.pop()
    return tuple(_shortened(line.rstrip("\r").replace("\r", " ")) for line in lines)


def _shortened(line: str) -> str:
    if len(line) <= LONGEST_LINE:
        return line
    return f"{line[:LONGEST_LINE]} [{len(line) - LONGEST_LINE:,} more characters]"


def blob_id(content: bytes) -> str:
    """Return git's id of a file with this content, as runs keep it."""
    return sha1(b"blob %d\0" % len(content) + content, usedforsecurity=False).hexdigest()
