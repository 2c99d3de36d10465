"""Workflow commands of GitHub Actions: each finding becomes an annotation of its line.

GitHub keeps the first ten errors, ten warnings and ten notices of a step, so the most severe come first and the last
line says how many there are.
"""

from __future__ import annotations

from typing import TextIO

from roslens.model.finding import Severity
from roslens.model.words.plural import plural
from roslens.report.run.reported import Reported, Wanted, reported
from roslens.report.writing.control_characters import shown_controls
from roslens.store.read import RunView

_COMMANDS = {Severity.NOTE: "notice", Severity.WARNING: "warning", Severity.ERROR: "error"}
KEPT = 10
"""Annotations of a kind that GitHub keeps of a step."""


def write_github(view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write a command for each finding that counts and each failure, and a line with the number of all.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    findings = reported(view, wanted)
    failures = view.failures()
    broken = [result for result in wanted.gate if result.holds is False]
    stream.writelines(_command("error", {}, f"gate {result.condition}", result.text) for result in broken)
    for failure in sorted(failures, key=lambda failure: failure.partial):
        place = failure.location
        where = {"file": wanted.below + place.path, "line": str(max(1, place.line))} if place else {}
        stream.write(_command("warning" if failure.partial else "error", where, "not analysed", str(failure)))
    stream.writelines(
        _command(_COMMANDS[one.finding.severity], _where(one), one.finding.rule, one.finding.message)
        for one in findings
    )
    kept = f"; GitHub shows the first {KEPT} of a kind" if len(findings) > KEPT else ""
    stream.write(f"roslens: {plural(len(findings), 'finding')}, {plural(len(failures), 'failure')}{kept}\n")


def _where(one: Reported) -> dict[str, str]:
    if not one.path:
        return {}
    where = {"file": one.path, "line": str(one.line)}
    if one.finding.line and one.finding.end_line > one.line:
        where["endLine"] = str(one.finding.end_line)
    elif one.finding.line and one.finding.column:
        where["col"] = str(one.finding.column)
    return where


def _command(kind: str, where: dict[str, str], title: str, message: str) -> str:
    properties = ",".join(f"{key}={_property(value)}" for key, value in {**where, "title": title}.items())
    return f"::{kind} {properties}::{_escaped(message)}\n"


def _escaped(text: str) -> str:
    return shown_controls(text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A"))


def _property(text: str) -> str:
    return _escaped(text).replace(":", "%3A").replace(",", "%2C")
