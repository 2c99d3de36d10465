"""From a package's result to what overview, graph and terminal need of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import msgspec

from roslens.judge.quality.fold_limits import limits_broken
from roslens.model.entity import EntityKind
from roslens.model.finding import Finding, Severity
from roslens.model.result import PackageResult, PackageSummary, RuleCount
from roslens.model.source import Dependency, Package
from roslens.model.weight.consequence import Certainty
from roslens.store.encodable import storable_values

_NO_EDGE = frozenset({"conflict", "replace", "group"})
"""Kinds of dependency that do not need the other package."""


def summarise(result: PackageResult) -> PackageSummary:
    """Return the summary of a package.

    ``rules`` has one count for each rule, severity, certainty and set of tags, so that filters on severities and tags
    are exact on summaries; most severe first, then most frequent. Its example is the worst occurrence that counts for
    gates (the worst of all if none does, the first among equals), written ``path:line: message``, or with its place
    last where the message begins with a number: ``30 calls (limit 5, 6.0 x) in f, path:line``.
    """
    package = result.package
    kinds = Counter(entity.kind for entity in result.entities)
    own = next((entity for entity in result.entities if entity.kind is EntityKind.PACKAGE), None)
    return PackageSummary(
        id=package.id,
        name=package.name,
        path=package.path,
        version=package.version,
        build_type=package.build_type,
        description=" ".join(package.description.split()),
        repository=package.repository,
        metapackage=package.metapackage,
        dependencies=dependencies_of(package),
        values=storable_values(own.values) if own else {},
        rules=rule_counts(result.findings),
        files=len(result.files),
        classes=kinds[EntityKind.CLASS],
        functions=kinds[EntityKind.FUNCTION],
        failures=len(result.failures),
        languages=dict(sorted(Counter(file.language.value for file in result.files).items())),
        roles=dict(sorted(Counter(file.role.value for file in result.files).items())),
        limits=dict(sorted(_limits(result.findings).items())),
        includes=result.includes,
        copy_of=package.copy_of,
    )


def _limits(findings: Iterable[Finding]) -> Counter[str]:
    found: Counter[str] = Counter()
    for finding in findings:
        if finding.gated and finding.others:
            found.update(limits_broken(finding))
    return found


def dependencies_of(package: Package) -> tuple[str, ...]:
    """Return the names of the packages that this one needs: conditions hold, each once, sorted."""
    return tuple(sorted({dependency.name for dependency in package.dependencies if _needed(dependency)}))


def _needed(dependency: Dependency) -> bool:
    return dependency.active and dependency.kind not in _NO_EDGE


class _Group:
    __slots__ = ("count", "example", "fixable", "gated")

    def __init__(self) -> None:
        self.count = 0
        self.gated = 0
        self.fixable = 0
        self.example: Finding | None = None


def rule_counts(findings: Iterable[Finding]) -> tuple[RuleCount, ...]:
    """Return how often each rule was broken, as :func:`summarise` has it."""
    groups: dict[tuple[str, Severity, Certainty | None, tuple[str, ...]], _Group] = {}
    for finding in findings:
        key = (finding.rule, finding.severity, finding.certainty, finding.tags)
        group = groups.get(key)
        if group is None:
            group = groups[key] = _Group()
        if group.example is None or (finding.gated, finding.excess) > (group.example.gated, group.example.excess):
            group.example = finding
        group.count += 1
        group.gated += finding.gated
        group.fixable += finding.gated and bool(finding.edits)
    counts = [
        RuleCount(
            rule,
            severity,
            group.count,
            group.gated,
            example_of(group.example) if group.example else "",
            tags,
            round(group.example.excess, 6) if group.example else 0.0,
            group.fixable,
            group.example.path if group.example else "",
            group.example.consequence if group.example else None,
            certainty,
            group.example.line if group.example else 0,
        )
        for (rule, severity, certainty, tags), group in groups.items()
    ]
    return tuple(sorted(counts, key=_order))


def with_share(summary: PackageSummary, share: PackageSummary) -> PackageSummary:
    """Return a package's summary with the findings that only all packages together show of it."""
    counts = {(one.rule, one.severity, one.certainty, one.tags): one for one in summary.rules}
    for one in share.rules:
        key = (one.rule, one.severity, one.certainty, one.tags)
        own = counts.get(key)
        counts[key] = one if own is None else _merged(own, one)
    return msgspec.structs.replace(summary, rules=tuple(sorted(counts.values(), key=_order)))


def _merged(own: RuleCount, one: RuleCount) -> RuleCount:
    worse = (one.gated > 0, one.excess) > (own.gated > 0, own.excess)
    return msgspec.structs.replace(
        one if worse else own,
        count=own.count + one.count,
        gated=own.gated + one.gated,
        fixable=own.fixable + one.fixable,
    )


def _order(count: RuleCount) -> tuple[int, int, str, int, tuple[str, ...]]:
    return (-count.severity.rank, -count.count, count.rule, -count.weight[1].rank, count.tags)


def example_of(finding: Finding) -> str:
    """Return a finding with its place in front, or behind it where its message begins with a number."""
    place = f"{finding.path}:{finding.line}" if finding.path and finding.line else finding.path or finding.entity
    if finding.value is not None and finding.bound is not None:
        return finding.message if place in finding.message else f"{finding.message}, {place}"
    return f"{place}: {finding.message}" if place else finding.message
