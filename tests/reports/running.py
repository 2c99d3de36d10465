"""What ``roslens check .`` with default options says of a copy of a workspace, in this process."""

from __future__ import annotations

import contextlib
import io
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

import msgspec

from roslens.cli.main import main

PLATFORM = ("AMENT_", "CMAKE_PREFIX_PATH", "COLCON_", "ROS_", "ROSLENS_")
"""Beginnings of variables that say what is installed here: left out, so that every machine says the same."""


class Finding(msgspec.Struct, frozen=True):
    """The fields of a finding in the JSON report that a score needs; its documentation is docs/reference/report.md."""

    rule: str
    severity: str
    message: str
    path: str = ""
    line: int = 0
    end_line: int = 0
    quantity: str | None = None

    def __str__(self) -> str:
        place = f"{self.path}:{self.line}" if self.line else self.path
        return f"{self.severity} {self.rule} {place}: {self.message}"


class Failure(msgspec.Struct, frozen=True):
    """What could not be done: the fields of the JSON report that a score needs."""

    what: str
    expected: str = ""
    path: str = ""
    line: int = 0

    def __str__(self) -> str:
        place = f"{self.path}:{self.line}" if self.line else self.path
        return f"{place}: {self.what} {self.expected}".strip()


class Said(msgspec.Struct, frozen=True):
    """What a run says of a workspace.

    Attributes:
        findings: in the order of the report.
        failures: what could not be done.
    """

    findings: list[Finding]
    failures: list[Failure]


def check(workspace: Path) -> Said:
    """Run the command on a copy of a workspace.

    Raises:
        RuntimeError: it wrote no report; the message has its exit code and the end of what it printed.
    """
    with tempfile.TemporaryDirectory(prefix="reports-") as top:
        copy = Path(top) / "workspace"
        report = Path(top) / "report.json"
        shutil.copytree(workspace, copy)
        printed = io.StringIO()
        with _inside(copy), contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            code = main(["check", ".", "--no-store", "-q", "-o", str(report)])
        if not report.is_file():
            raise RuntimeError(f"{workspace}: exit code {code} and no report: {printed.getvalue().strip()[-300:]}")
        return msgspec.json.decode(report.read_bytes(), type=Said)


@contextlib.contextmanager
def _inside(folder: Path) -> Iterator[None]:
    before, environment = Path.cwd(), dict(os.environ)
    for name in environment:
        if name.startswith(PLATFORM):
            del os.environ[name]
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)
        os.environ.clear()
        os.environ.update(environment)
