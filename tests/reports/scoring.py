"""What a developer gets of a report: whether its mistake is told, and what is said of the corrected form.

- *told*: a warning or an error stands at an expected place and speaks of the right thing.
- *note*: only a note does.
- *failure*: only the list of what could not be done says it.
- *silent*: nothing does.

A *false alarm* is a warning or an error in the corrected form. Limits of metrics count neither way: they know nothing
of the mistake, and a workspace of twenty lines exceeds some of them.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path, PurePosixPath
from typing import Literal, get_args

import msgspec

from reports.report_case import Place, Rebuilt
from reports.running import Failure, Finding, Said, check

Verdict = Literal["told", "note", "failure", "silent"]
VERDICTS: tuple[Verdict, ...] = get_args(Verdict)
"""From best to worst."""

GRAVE = frozenset({"warning", "error"})
_METRIC = re.compile(r"\.(max|min)$|\.(function|class)_limits\b|comment_ratio")
_LONG = 5
"""A finding that spans more lines than this stands at its first line: a whole class is no place."""


class Score(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What the runs on the forms of a case come to.

    Attributes:
        name: of the case.
        verdict: on the mistake; None where the case has a correct form only.
        by: the finding or failure that the verdict is for; empty where there is none.
        alarms: what is wrongly said of the correct form.
    """

    name: str
    verdict: Verdict | None
    by: str
    alarms: list[str]


def score(one: Rebuilt, run: Callable[[Path], Said] = check) -> Score:
    """Run the command on the forms of a case and compare what it says with what is expected.

    Raises:
        RuntimeError: a run wrote no report.
    """
    good = run(one.folder / "good")
    alarms = [str(finding) for finding in good.findings if finding.severity in GRAVE and not of_metric(finding)]
    if not one.case.bad:
        return Score(one.name, None, "", alarms)
    verdict, by = judge(one.case.bad, run(one.folder / "bad"), one.folder / "bad")
    return Score(one.name, verdict, by, alarms)


def judge(places: Sequence[Place], said: Said, workspace: Path) -> tuple[Verdict, str]:
    """Return the verdict on a mistake, and the text of what it is for."""
    hits = [
        finding
        for finding in said.findings
        if not of_metric(finding) and any(fits(finding, place, workspace) for place in places)
    ]
    for finding in hits:
        if finding.severity in GRAVE:
            return "told", str(finding)
    if hits:
        return "note", str(hits[0])
    for failure in said.failures:
        if any(_failure_fits(failure, place) for place in places):
            return "failure", str(failure)
    return "silent", ""


def of_metric(finding: Finding) -> bool:
    """Whether a finding is about a limit of a metric."""
    return finding.quantity is not None or bool(_METRIC.search(finding.rule))


def fits(finding: Finding, place: Place, workspace: Path) -> bool:
    """Whether a finding stands at a place and speaks of the right thing.

    A finding in a file outside of the workspace stands where its message says: it is about an installed node.
    """
    if finding.path and not (workspace / finding.path).exists():
        named = re.findall(re.escape(place.path) + r":(\d+)", finding.message)
        at_place = any(_within(int(line), int(line), place) for line in named)
    else:
        first = max(finding.line, 1)
        last = max(finding.end_line, first)
        at_place = PurePosixPath(finding.path) == PurePosixPath(place.path) and _within(
            first, last if last - first <= _LONG else first, place
        )
    return at_place and _speaks(f"{finding.rule}\n{finding.message}", place)


def _within(first: int, last: int, place: Place) -> bool:
    return place.lines is None or (first <= place.lines[1] and last >= place.lines[0])


def _speaks(text: str, place: Place) -> bool:
    return any(word.lower() in text.lower() for word in place.any)


def _failure_fits(failure: Failure, place: Place) -> bool:
    text = str(failure)
    return (place.path in text or PurePosixPath(place.path).name in text) and _speaks(text, place)
