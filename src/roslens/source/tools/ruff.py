"""The tool ``ruff``: Python, as pyflakes, pycodestyle and a hundred others see it."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.plugins.points import Option
from roslens.source.tools.run_tool import Ended
from roslens.source.tools.tool import Reading, Request, Tool, ToolFinding, below_root, unreadable

_SYNTAX = "syntax-error"


class _Place(msgspec.Struct, frozen=True):
    row: int
    column: int


class _Finding(msgspec.Struct, frozen=True):
    filename: str
    message: str
    location: _Place
    code: str | None = None
    name: str | None = None
    end_location: _Place | None = None


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
    options = (
        Option("select", "list", "Rules or families; empty: what the project's settings say, or ruff's own.", []),
    )

    def words(self, request: Request) -> list[str]:
        """Return the call; settings of the project are ruff's own affair, and hold nothing that runs."""
        chosen = [f"--select={','.join(request.options['select'])}"] if request.options["select"] else []
        return [
            request.program,
            "check",
            "--output-format=json",
            "--no-cache",
            "--no-fix",
            "--force-exclude",
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
