"""The findings of a run as other programs read them: those that count, in the order to fix them, with their files."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import PurePosixPath

import msgspec

from roslens.judge.quality.gate import GateResult
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.same_finding import Key, key_of_finding
from roslens.model.tags import TagFilter
from roslens.report.run.fix_first import METRICS
from roslens.store.read import RunView


class Wanted(msgspec.Struct, frozen=True):
    """What a report is to show.

    Attributes:
        tags: of findings that are meant.
        below: folder of the workspace below that of its repository, empty or with ``/`` at its end. Code hosts look for
            files from the root of the repository.
        fail_on: severity from which a finding fails the check, or ``never``.
        accept_partial: whether files that were analysed in part pass.
        baseline: what the run is compared with; empty for nothing.
        new: findings that the baseline does not have; None where there is none.
        gone: how many findings of the baseline are gone.
        gate: conditions of the configuration, and whether they hold.
        changes: in how many commits of the last year files of findings changed, as far as known.
    """

    tags: TagFilter = TagFilter()
    below: str = ""
    fail_on: str = Severity.ERROR.value
    accept_partial: bool = False
    baseline: str = ""
    new: frozenset[Key] | None = None
    gone: int = 0
    gate: tuple[GateResult, ...] = ()
    changes: Mapping[str, int] = {}

    def is_new(self, finding: Finding) -> bool:
        """Return whether a finding is new since the baseline; without one none is."""
        return self.new is not None and key_of_finding(finding) in self.new

    def fails(self, severity: Severity) -> bool:
        """Return whether a finding of this severity fails the check."""
        return self.fail_on != "never" and severity.rank >= Severity(self.fail_on).rank

    def is_failing(self, finding: Finding) -> bool:
        """Return whether a finding that counts fails the check: with a baseline only one that is new."""
        return self.fails(finding.severity) and (self.new is None or self.is_new(finding))


class Reported(msgspec.Struct, frozen=True):
    """A finding, the package that it belongs to, and its file.

    ``path`` is below the root of the repository; where the finding has no file of its own it is the manifest of the
    package, and empty where it has no package either. ``line`` is 1 where the finding has none.
    """

    package: str
    finding: Finding
    path: str
    line: int


def reported(view: RunView, wanted: Wanted) -> list[Reported]:
    """Return the findings that count for gates, in the order in which to fix them: new ones first, notes last."""
    manifests = {one.id: one.path for one in view.packages()}
    found = []
    for package, finding in view.owned_findings(wanted.tags):
        if finding.gated:
            path = finding.path or _manifest(package or finding.entity.partition(":")[2], manifests)
            found.append(Reported(package, finding, wanted.below + path if path else "", max(1, finding.line)))
    return sorted(found, key=lambda one: _order(one.finding, wanted))


def _order(finding: Finding, wanted: Wanted) -> tuple[bool, bool, int, int, int, bool, int, float]:
    consequence, certainty = finding.weight
    return (
        finding.severity is Severity.NOTE,
        METRICS in finding.tags,
        -consequence.rank,
        -certainty.rank,
        -finding.severity.rank,
        not wanted.is_new(finding),
        -wanted.changes.get(finding.path, 0),
        -finding.excess,
    )


def _manifest(package: str, folders: dict[str, str]) -> str:
    folder = folders.get(package)
    return str(PurePosixPath(folder, "package.xml")) if folder is not None and not package.startswith("(") else ""


def aside(view: RunView, tags: TagFilter) -> int:
    """Return how many findings do not count: those in test, generated and vendored code."""
    return sum(not finding.gated for finding in view.findings(tags=tags))


def rules_by_id(view: RunView) -> dict[str, RuleInfo]:
    """Return what is known of the rules that findings name."""
    return {rule.id: rule for rule in view.rules()}


_NO_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def xml_text(text: str) -> str:
    """Return text without characters that XML 1.0 cannot hold; each is replaced."""
    return _NO_XML.sub("\N{REPLACEMENT CHARACTER}", text)
