"""The tool ``ruff``: Python, as pyflakes, pycodestyle and a hundred others see it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec

from roslens.model.edit import Edit, edit_at
from roslens.plugins.points import Option
from roslens.source.tools.running.run_tool import Ended
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding, ToolFix, below_root, unreadable

_SYNTAX = "syntax-error"
_MARK = b"\xef\xbb\xbf"


class _Place(msgspec.Struct, frozen=True):
    row: int
    column: int


class _Edit(msgspec.Struct, frozen=True):
    content: str
    location: _Place
    end_location: _Place


class _Fix(msgspec.Struct, frozen=True):
    applicability: str
    edits: tuple[_Edit, ...] = ()


class _Finding(msgspec.Struct, frozen=True):
    filename: str
    message: str
    location: _Place
    code: str | None = None
    name: str | None = None
    end_location: _Place | None = None
    fix: _Fix | None = None


class Ruff(Tool):
    """Python; a hundred thousand lines a second."""

    name = "ruff"
    program = "ruff"
    text = "Python mistakes and style: pyflakes, pycodestyle, bugbear and others."
    get = "pip install 'roslens[tools]', or pip install ruff"
    languages = ("python", "launch_python")
    version_pattern = r"ruff (\d+(?:\.\d+)+)"
    oldest = (0, 4)
    settings_files = ("pyproject.toml", "ruff.toml", ".ruff.toml")
    parallel = False
    at_once = 4000
    fixes_at_once = 4000
    options = (
        Option(
            "select", "list", "Rules or families; empty: those of the project's settings, or the defaults of ruff.", []
        ),
    )

    def words(self, request: Request) -> list[str]:
        """Return the call; settings of the project count once they are trusted."""
        chosen = [f"--select={','.join(request.options['select'])}"] if request.options["select"] else []
        return [
            request.program,
            "check",
            "--output-format=json",
            "--no-cache",
            "--no-fix",
            "--force-exclude",
            *([] if request.own_settings else ["--isolated"]),
            *chosen,
            "--",
            *request.files,
        ]

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read the JSON array of standard output."""
        try:
            found = msgspec.json.decode(ended.stdout, type=list[_Finding])
        except msgspec.DecodeError:
            raise unreadable(ended.stdout, "a JSON array of findings") from None
        return Reading(tuple(_once_where_unreadable(tuple(_finding(one, request.root) for one in found))))

    def read_fixes(self, ended: Ended, request: Request, contents: Mapping[str, bytes]) -> Iterator[ToolFix]:
        """Yield the fixes that ruff calls safe; of a file with a byte order mark or other line ends none."""
        try:
            found = msgspec.json.decode(ended.stdout, type=list[_Finding])
        except msgspec.DecodeError:
            raise unreadable(ended.stdout, "a JSON array of findings") from None
        for one in found:
            path = below_root(one.filename, request.root)
            content = contents.get(path)
            if content is None or one.fix is None or one.fix.applicability != "safe" or one.code is None:
                continue
            if content.startswith(_MARK) or b"\r" in content or b"\x0c" in content:
                continue
            lines = content.splitlines(keepends=True)
            try:
                edits = tuple(_edit(edit, content, lines, path) for edit in one.fix.edits)
            except UnicodeDecodeError:
                continue
            yield ToolFix(path, one.location.row, one.location.column, one.code, edits)


def _edit(one: _Edit, content: bytes, lines: list[bytes], path: str) -> Edit:
    start, end = _offset(one.location, lines), _offset(one.end_location, lines)
    return edit_at(content, start, end, one.content, path)


def _offset(place: _Place, lines: list[bytes]) -> int:
    """Return the offset of a place that ruff counts in lines and letters, both from 1."""
    before = sum(map(len, lines[: place.row - 1]))
    line = lines[place.row - 1] if place.row <= len(lines) else b""
    return before + len(line.decode()[: place.column - 1].encode())


def _finding(one: _Finding, root: str) -> ToolFinding:
    return ToolFinding(
        below_root(one.filename, root),
        one.location.row,
        one.location.column,
        _SYNTAX if one.code in (None, "invalid-syntax") else str(one.code),
        one.message,
        one.end_location.row if one.end_location else 0,
        one.end_location.column if one.end_location else 0,
    )


def _once_where_unreadable(found: tuple[ToolFinding, ...]) -> Iterator[ToolFinding]:
    """Yield findings; of the places where a file is no Python 3 only the first, for the rest follows from it."""
    begun: set[str] = set()
    for one in sorted(found):
        if one.check == _SYNTAX:
            if one.path in begun:
                continue
            begun.add(one.path)
        yield one


plugin = Ruff()
