"""Files as lines to show: read once, checked against the run, coloured, cut into excerpts."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence
from functools import lru_cache
from hashlib import sha1
from typing import TYPE_CHECKING

import msgspec

from roslens.model.source import SourceFile

if TYPE_CHECKING:
    from pygments.lexer import Lexer

ReadSource = Callable[[str], bytes | None]
"""Gives the content of a file by its path below the workspace root; None where it cannot."""

AROUND = 2
LONGEST_LINE = 400
_KEPT = 256
_LEXERS = {
    "c": "c",
    "cpp": "cpp",
    "python": "python",
    "launch_python": "python",
    "cmake": "cmake",
    "manifest": "xml",
    "launch_xml": "xml",
    "launch_yaml": "yaml",
    "yaml": "yaml",
    "xml": "xml",
    "urdf": "xml",
    "xacro": "xml",
}
_CLASSES = (
    ("Comment.Preproc", "p"),
    ("Comment", "c"),
    ("Keyword.Type", "t"),
    ("Keyword", "k"),
    ("Literal.String", "s"),
    ("Literal.Number", "m"),
    ("Name.Function", "f"),
    ("Name.Class", "f"),
    ("Name.Decorator", "p"),
    ("Name.Tag", "k"),
    ("Name.Attribute", "t"),
    ("Name.Builtin", "t"),
    ("Operator.Word", "k"),
)

Piece = tuple[str, str]
"""Class of a piece of source (empty for none) and its text, not yet escaped."""


class SourceText(msgspec.Struct, frozen=True):
    """The lines of a file. ``changed`` says that it is no longer what the run saw."""

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


def colour(lines: Sequence[str], language: str) -> list[tuple[Piece, ...]]:
    """Return each line as coloured pieces; plain where the language has no lexer."""
    lexer = _lexer(_LEXERS.get(language, ""))
    if lexer is None:
        return [(("", line),) for line in lines]
    coloured: list[list[Piece]] = [[]]
    # Some lexers know the end of a comment only by the end of its line, so the last line gets one too.
    for kind, text in lexer.get_tokens("\n".join(lines) + "\n"):
        name = _class_of(str(kind))
        first, *others = text.split("\n")
        _append(coloured[-1], name, first)
        for other in others:
            coloured.append([])
            _append(coloured[-1], name, other)
    return [tuple(coloured[place]) if place < len(coloured) else () for place in range(len(lines))]


def _append(line: list[Piece], name: str, text: str) -> None:
    if not text:
        return
    if line and line[-1][0] == name:
        line[-1] = (name, line[-1][1] + text)
    else:
        line.append((name, text))


@lru_cache(maxsize=256)
def _class_of(kind: str) -> str:
    name = kind.removeprefix("Token.")
    return next((css for prefix, css in _CLASSES if name.startswith(prefix)), "")


@lru_cache(maxsize=16)
def _lexer(name: str) -> Lexer | None:
    if not name:
        return None
    from pygments.lexers import get_lexer_by_name

    return get_lexer_by_name(name, stripnl=False, ensurenl=False)
