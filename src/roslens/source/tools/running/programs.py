"""Where a tool's program is, and of which version it is."""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path

import msgspec

from roslens.children.sandbox import Sandbox, program_folders
from roslens.children.scratch_folder import ScratchFolder
from roslens.source.tools.running.run_tool import ToolError, ToolRunner
from roslens.source.tools.tool import Tool

VERSION_LIMIT_S = 30.0


class Program(msgspec.Struct, frozen=True):
    """A program that is there; ``identity`` changes when another one takes its place."""

    path: str
    identity: str


def find_program(name: str, root: str) -> Program | None:
    """Return the program of a name: beside the Python that runs roslens, else on the search path.

    One that lies in the workspace is none: what is looked at must not choose what looks.
    """
    beside = str(Path(sys.executable).parent)
    for folder in (beside, *os.environ.get("PATH", os.defpath).split(os.pathsep)):
        path = os.path.join(folder, name)  # noqa: PTH118 - no Path a folder
        if not os.path.isabs(folder) or not os.access(path, os.X_OK) or not os.path.isfile(path):  # noqa: PTH117, PTH113
            continue
        real = os.path.realpath(path)
        if _is_below(real, root) and not _is_below(real, beside):
            continue
        stat = os.stat(real)  # noqa: PTH116
        return Program(path, f"{real}:{stat.st_size}:{stat.st_mtime_ns}")
    return None


def version_of(tool: Tool, program: Program, runner: ToolRunner) -> str:
    """Ask a program for its version.

    Raises:
        ToolError: it does not say, or is older than any that was tried.
    """
    with ScratchFolder("version") as scratch:
        sandbox = Sandbox(run=program_folders(program.path), write=(scratch,))
        words = [program.path, *tool.version_words]
        ended = runner.run(words, folder=scratch, time_limit_s=VERSION_LIMIT_S, sandbox=sandbox)
    reported = (ended.stdout + b"\n" + ended.stderr)[:65536].decode("utf-8", "replace")
    match = re.search(tool.version_pattern, reported)
    if match is None:
        call = " ".join((tool.program, *tool.version_words))
        raise ToolError(f"is of an unknown version: `{call}` reports {' '.join(reported.split())[:80]!r}")
    return match[1]


def check_age(tool: Tool, version: str) -> None:
    """Refuse a version that is older than any that was tried.

    Raises:
        ToolError: it is.
    """
    parts = tuple(int(part) for part in version.split(".") if part.isdigit())
    if parts < tool.oldest:
        raise ToolError(
            f"is of version {version}, and versions before {'.'.join(map(str, tool.oldest))} were not tried"
        )


def _is_below(path: str, folder: str) -> bool:
    return path.startswith(os.path.realpath(folder).rstrip("/") + "/")
