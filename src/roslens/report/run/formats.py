"""The formats of a result by name: which files have them, and who writes them."""

from __future__ import annotations

from pathlib import PurePath
from typing import TextIO

from roslens.report.run.reported import Wanted
from roslens.store.read import RunView

FORMATS = {
    "text": "for a terminal",
    "json": "everything, for programs",
    "csv": "tables, for spreadsheets",
    "sarif": "SARIF 2.1.0, for code hosts and editors",
    "junit": "JUnit XML, for colcon test-result, catkin_test_results, GitLab and Jenkins",
    "gitlab": "Code Quality JSON, for merge requests of GitLab",
    "github": "annotations of GitHub Actions",
    "checkstyle": "Checkstyle XML, for Jenkins and reviewdog",
    "markdown": "a summary, for pull requests",
    "badge": "an SVG with the number of errors and warnings",
}
"""Name to what it is for."""

ENDINGS = {
    "": "text",
    ".txt": "text",
    ".log": "text",
    ".json": "json",
    ".csv": "csv",
    ".sarif": "sarif",
    ".md": "markdown",
    ".svg": "badge",
}
"""End of a file's name to the format that it has unless another is asked for."""

_LONGER = {".sarif.json": "sarif", ".junit.xml": "junit", ".checkstyle.xml": "checkstyle"}


def format_of(name: str) -> str | None:
    """Return the format that the name of a file asks for; None where it could be any."""
    lower = PurePath(name).name.lower()
    for ending, format_ in _LONGER.items():
        if lower.endswith(ending):
            return format_
    return ENDINGS.get(PurePath(lower).suffix)


def write_format(name: str, view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write a run in any format but ``text``, which needs to know the terminal.

    Raises:
        KeyError: there is no such format.
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    if name == "json":
        from roslens.report.run.to_json import write_json

        write_json(view, stream, wanted.tags, wanted.is_new if wanted.new is not None else None)
    elif name == "csv":
        from roslens.report.run.to_csv import write_findings

        write_findings(view, stream, wanted.tags)
    else:
        _of_findings(name, view, stream, wanted)


def _of_findings(name: str, view: RunView, stream: TextIO, wanted: Wanted) -> None:
    from roslens.report.run.to_badge import write_badge
    from roslens.report.run.to_checkstyle import write_checkstyle
    from roslens.report.run.to_code_quality import write_code_quality
    from roslens.report.run.to_github import write_github
    from roslens.report.run.to_junit import write_junit
    from roslens.report.run.to_markdown import write_markdown
    from roslens.report.run.to_sarif import write_sarif

    writers = {
        "sarif": write_sarif,
        "junit": write_junit,
        "gitlab": write_code_quality,
        "github": write_github,
        "checkstyle": write_checkstyle,
        "markdown": write_markdown,
        "badge": write_badge,
    }
    writers[name](view, stream, wanted)
