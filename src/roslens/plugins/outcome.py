"""What plug-ins yielded: raw reports made into findings, measurements and failures in a fixed order."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

import msgspec

from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, fingerprint
from roslens.model.quantity import Measurement
from roslens.plugins.contract_failures import BREACH, Violation, breaks_contract


class RawFinding(msgspec.Struct, frozen=True, array_like=True, gc=False, order=True):
    """A finding as a hook reported it, checked, before the rule's own facts are added."""

    path: str
    line: int
    column: int
    rule: str
    entity: str
    message: str
    end_line: int = 0
    end_column: int = 0
    context: str = ""


class Outcome(msgspec.Struct, frozen=True):
    """What plug-ins found, measured and could not do, each sorted by place."""

    findings: tuple[Finding, ...] = ()
    measurements: tuple[Measurement, ...] = ()
    failures: tuple[Failure, ...] = ()

    def __add__(self, other: Outcome) -> Outcome:
        """Return both together, sorted again; what failed for several plug-ins alike failed once."""
        return Outcome(
            tuple(sorted((*self.findings, *other.findings), key=_finding_order)),
            tuple(sorted((*self.measurements, *other.measurements), key=_measurement_order)),
            tuple(sorted(dict.fromkeys((*self.failures, *other.failures)), key=_failure_order)),
        )


def settle(
    tool: str,
    rules: Mapping[str, RuleInfo],
    findings: Iterable[RawFinding],
    measurements: Iterable[Measurement],
    failures: Iterable[Failure],
) -> Outcome:
    """Return what one plug-in reported as findings with severity, tags and stable fingerprints.

    A finding reported twice in all its parts is one; so is a failure. Breaches of one kind become
    one failure that says how often: a plug-in that misspells a rule does so in every file. Of two
    values of a quantity for one entity the smaller stands and the other is a breach.
    """
    values, doubled = _single(tool, measurements)
    return Outcome(
        tuple(sorted(_finished(tool, rules, findings), key=_finding_order)),
        values,
        tuple(sorted(_gathered((*failures, *doubled)), key=_failure_order)),
    )


def _single(tool: str, measurements: Iterable[Measurement]) -> tuple[tuple[Measurement, ...], list[Failure]]:
    values: dict[tuple[str, str], Measurement] = {}
    doubled: list[Failure] = []
    for measurement in sorted(measurements, key=lambda one: (*_measurement_order(one), one.value)):
        first = values.setdefault(_measurement_order(measurement), measurement)
        if first.value != measurement.value:
            breach = Violation(
                f"{first.value:g} and {measurement.value:g} for {measurement.quantity!r} of one entity", "one value"
            )
            doubled.append(breaks_contract(tool, breach, tool=tool, entity=measurement.entity))
    return tuple(values.values()), doubled


def _finished(tool: str, rules: Mapping[str, RuleInfo], findings: Iterable[RawFinding]) -> Iterable[Finding]:
    ordinals: Counter[tuple[str, str, str]] = Counter()
    for raw in sorted(set(findings)):
        rule = rules[raw.rule]
        place = raw.entity or raw.path
        twin = (raw.rule, place, " ".join(raw.context.split()))
        yield Finding(
            rule=raw.rule,
            severity=rule.severity,
            message=raw.message,
            path=raw.path,
            line=raw.line,
            column=raw.column,
            end_line=raw.end_line,
            end_column=raw.end_column,
            entity=raw.entity,
            tags=rule.tags,
            tool=rule.tool or tool,
            fingerprint=fingerprint(*twin, ordinal=ordinals[twin]),
            consequence=rule.consequence,
            certainty=rule.certainty,
        )
        ordinals[twin] += 1


def _gathered(failures: Iterable[Failure]) -> Iterable[Failure]:
    groups: dict[tuple[str, ...], list[Failure]] = {}
    for failure in failures:
        same_cause: tuple[str, ...] = (failure.tool, failure.what, failure.expected, failure.advice, failure.package)
        if BREACH not in failure.what:
            same_cause += (str(failure.location), failure.entity)
        group = groups.setdefault(same_cause, [])
        if failure not in group:
            group.append(failure)
    for group in groups.values():
        first = min(group, key=_failure_order)
        more = len(group) - 1
        yield msgspec.structs.replace(first, what=f"{first.what} (and {more} more times)") if more else first


def _finding_order(finding: Finding) -> tuple[Any, ...]:
    return (finding.path, finding.line, finding.column, finding.rule, finding.entity, finding.message)


def _measurement_order(measurement: Measurement) -> tuple[str, str]:
    return (measurement.entity, measurement.quantity)


def _failure_order(failure: Failure) -> tuple[str, ...]:
    place = str(failure.location.path) if failure.location else ""
    line = f"{failure.location.line:09}" if failure.location else ""
    return (failure.tool, failure.package, place, line, failure.entity, failure.what, failure.detail)
