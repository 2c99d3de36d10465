"""The tool ``cpplint``: the Google C++ style guide, and what ament_cpplint and roslint made of it for ROS."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from roslens.plugins.points import Option
from roslens.source.tools.running.run_tool import Ended
from roslens.source.tools.tool import (
    Reading,
    Request,
    Tool,
    ToolFinding,
    below_root,
    lines_that_match,
    own_paths,
    unreadable,
)

_FINDING = re.compile(r"(?P<path>.+?):(?P<line>\d+):  (?P<message>.*)  \[(?P<check>[\w/+]+)\] \[\d\]$")
_SKIPPED = re.compile(r"Skipping input '(?P<path>.*)': (?P<why>.*)$")
_IGNORED = re.compile(r"Ignoring (?P<path>.*); not a valid file name")
_DONE = re.compile(r"Done processing (?P<path>.*)$")
_NOISE = re.compile(r"Total errors found: \d+|Category '.*' errors found: \d+|Ignored '.*'|Done processing ")

FILTER = (
    "-build/c++11",
    "-build/c++17",
    "-build/header_guard",
    "-runtime/references",
    "-whitespace/braces",
    "-whitespace/indent",
    "-whitespace/parens",
    "-whitespace/semicolon",
)
"""What ament_cpplint turns off for ROS 2, and header guards: what they should be called depends on the workspace."""

SETTINGS = "CPPLINT.cfg"
APART = "workspace"
"""In the scratch, the folder with links to the files where the settings beside them do not count.

cpplint before 2.0 cannot be told to leave settings out, and looks for them above the path that it was given.
"""

_REPOSITORIES = (".git", ".hg", ".svn")
"""What tells cpplint where a repository begins, for the name by which a header is its source's own."""


class Cpplint(Tool):
    """Google style, line by line; about 2,500 lines a second."""

    name = "cpplint"
    program = "cpplint"
    text = "Google's C++ style guide, with the exceptions of ROS 2."
    get = "pip install 'roslens[tools]', or pip install cpplint"
    languages = ("c", "cpp")
    version_pattern = r"cpplint (\d+(?:\.\d+)+)"
    oldest = (1, 5)
    settings_files = (SETTINGS,)
    options = (
        Option("filter", "list", "Categories to add (`+`) or leave out (`-`), as cpplint's --filter.", list(FILTER)),
        Option("line_length", "int", "Characters that a line may have.", 100),
    )

    def words(self, request: Request) -> list[str]:
        """Return the call; ``Done processing`` is kept, as it shows which files were checked."""
        return [
            request.program,
            f"--filter={','.join(request.options['filter'])}",
            f"--linelength={request.options['line_length']}",
            "--extensions=c,cc,cpp,cxx,c++,cu,h,hh,hpp,hxx,h++,cuh,ipp,tpp,inl",
            "--",
            *(request.files if request.own_settings else _linked(request)),
        ]

    def read(self, ended: Ended, request: Request) -> Reading:
        """Read findings from standard error, and from standard output which files were done."""
        reported = ended.stderr.decode("utf-8", "replace")
        lines = (reported + "\n" + ended.stdout.decode("utf-8", "replace")).splitlines()
        done = {match["path"] for match in map(_DONE.match, lines) if match}
        found, rest = lines_that_match(_FINDING, reported)
        skipped: dict[str, str] = {}
        strange: list[str] = []
        for line in rest:
            if match := _SKIPPED.match(line):
                skipped[_path(match["path"], request)] = match["why"]
            elif match := _IGNORED.match(line):
                skipped[_path(match["path"], request)] = "not a file name that it accepts"
            elif not _NOISE.match(line):
                strange.append(line)
        if not done and not found and not skipped:
            raise unreadable(ended.stdout + ended.stderr, "`Done processing FILE` for each file")
        passed = {_path(path, request) for path in done}
        for path in own_paths(request):
            if path not in passed and path not in skipped:
                skipped[path] = "it does not report that it checked it"
        findings = tuple(
            ToolFinding(_path(match["path"], request), int(match["line"]), 0, match["check"], match["message"])
            for match in found
        )
        return Reading(findings, skipped, tuple(strange[:3]))


def _linked(request: Request) -> Iterator[str]:
    """Yield the paths of links to the files of a call, where no settings are beside or above them."""
    apart = Path(request.scratch, APART)
    apart.mkdir()
    (apart / SETTINGS).write_text("set noparent\n")
    known: set[Path] = set()
    for path in own_paths(request):
        link, real = apart / path, Path(request.root, path)
        link.parent.mkdir(parents=True, exist_ok=True)
        link.symlink_to(real)
        for there, here in zip((link, *link.parents), (real, *real.parents), strict=False):
            if there == apart.parent or there in known:
                break
            known.add(there)
            for name in _REPOSITORIES:
                if (here / name).exists():
                    (there / name).touch()
        yield str(link)


def _path(path: str, request: Request) -> str:
    """Return a path of the output below the root of the workspace."""
    return below_root(path, request.root if request.own_settings else str(Path(request.scratch, APART)))


plugin = Cpplint()
