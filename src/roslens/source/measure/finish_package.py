"""From what was measured of a package to its result: judged, suppressed, gated, counted."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence

import msgspec

from roslens.judge.quality.fold_limits import fold_limits
from roslens.judge.quality.quality_model import QualityModel
from roslens.judge.quality.thresholds import judge_entities
from roslens.model.entity import Entity
from roslens.model.failure import Failure
from roslens.model.finding import Finding, Severity
from roslens.model.result import PackageResult
from roslens.model.source import Package, SourceFile
from roslens.plugins.outcome import Outcome
from roslens.source.measure.analyse_package import MeasuredPackage
from roslens.source.metrics.packages import rcv, rqv
from roslens.source.metrics.size import comment_ratio
from roslens.source.settings import SourceSettings
from roslens.source.tools.running.layout import RULE as LAYOUT
from roslens.source.tools.running.layout import layout_folded
from roslens.source.tools.witnesses import joined
from roslens.source.workspace.silence import UNUSED, Nameable, Silence, about_comments


class Finisher:
    """Judges packages by the models of a run and marks which findings count for its gate."""

    def __init__(
        self,
        settings: SourceSettings,
        models: Sequence[QualityModel],
        packages: Mapping[str, Package],
        files: Mapping[str, tuple[SourceFile, ...]],
        failures: Iterable[Failure],
        silence: Silence | None = None,
        rules: Callable[[Package], Nameable] = lambda _package: Nameable(),
    ) -> None:
        """``failures`` of reading and finding are handed to the package that each names.

        ``silence`` says which findings do not count; ``rules`` returns those that comments in a package may name.
        """
        self._silence = silence or Silence()
        self._rules = rules
        self._fold_layout = settings.tools.layout == "fold"
        self._gate_roles = frozenset(settings.gate_roles)
        self._models = models
        self._packages = packages
        self._files = files
        self._failures: dict[str, list[Failure]] = defaultdict(list)
        for failure in failures:
            if failure.package:
                self._failures[failure.package].append(failure)

    def finish(self, measured: MeasuredPackage, outcome: Outcome) -> PackageResult:
        """Return the package's result with ``rqv`` and ``rcv`` among its values."""
        files = self._files[measured.package]
        roles = {file.path: file.role.value for file in files}
        entities = with_measurements(measured.entities, outcome)
        package = self._packages[measured.package]
        judged: tuple[Finding, ...] = joined(
            (*measured.findings, *outcome.findings, *map(_as_said, judge_entities(self._models, entities)))
        )
        if measured.suppressions:
            about = about_comments(measured.suppressions, (*judged, *fold_limits(judged)), self._rules(package))
            # What only the whole package shows may be what a comment hides.
            judged = (*judged, *(one for one in about if not (measured.in_part and one.rule == UNUSED.id)))
        sorted_out = self._silence.sorted_out(
            judged, measured.suppressions, folder=package.path, package=measured.package
        )
        # A limit may be set aside by itself, and what stands for several of them, too.
        folded = self._silence.sorted_out(
            fold_limits(sorted_out.kept), measured.suppressions, folder=package.path, package=measured.package
        )
        findings = []
        for finding in folded.kept:
            if finding.path and roles.get(finding.path, "own") not in self._gate_roles:
                findings.append(msgspec.structs.replace(finding, gated=False))
            else:
                findings.append(finding)
        findings.sort(key=_place)
        shown = layout_folded(findings, package) if self._fold_layout else tuple(findings)
        # The one finding about layout can be accepted and ignored like those that it stands for.
        laid_out = self._silence.sorted_out(
            [finding for finding in shown if finding.rule == LAYOUT.id],
            measured.suppressions,
            folder=package.path,
            package=measured.package,
        )
        shown = tuple(finding for finding in shown if finding.rule != LAYOUT.id)
        return PackageResult(
            package=package,
            files=files,
            entities=_with_counts(entities, findings),
            findings=(*shown, *laid_out.kept),
            failures=(*self._failures[measured.package], *measured.failures, *outcome.failures),
            set_aside=(*sorted_out.set_aside, *folded.set_aside, *laid_out.set_aside),
            includes=measured.includes,
        )


def _as_said(finding: Finding) -> Finding:
    """Return a finding of a model; as a note if the file documents itself without comments."""
    if finding.quantity == comment_ratio.QUANTITY.key and comment_ratio.speaks_for_itself(finding.path):
        return msgspec.structs.replace(finding, severity=Severity.NOTE)
    return finding


def with_measurements(entities: Sequence[Entity], outcome: Outcome) -> tuple[Entity, ...]:
    """Return the entities with what plug-ins measured of them."""
    if not outcome.measurements:
        return tuple(entities)
    extra: dict[str, dict[str, float]] = defaultdict(dict)
    for measurement in outcome.measurements:
        extra[measurement.entity][measurement.quantity] = measurement.value
    return tuple(
        msgspec.structs.replace(entity, values={**entity.values, **extra[entity.id]}) if entity.id in extra else entity
        for entity in entities
    )


def _with_counts(entities: Sequence[Entity], findings: Sequence[Finding]) -> tuple[Entity, ...]:
    package, *others = entities
    gated = [finding for finding in findings if finding.gated]
    counts = {rqv.QUANTITY.key: rqv.of_findings(gated), rcv.QUANTITY.key: rcv.of_findings(gated)}
    return (msgspec.structs.replace(package, values={**package.values, **counts}), *others)


def _place(finding: Finding) -> tuple[str, int, int, str, str]:
    return (finding.path, finding.line, finding.column, finding.rule, finding.entity)
