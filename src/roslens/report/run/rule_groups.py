"""Findings by rule and severity, in the order in which they are listed, and which of them are listed at all."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

import msgspec

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.tags import TagFilter
from roslens.report.run.fix_first import METRICS, is_listed, urgency


class RuleGroup(msgspec.Struct):
    """The findings of a rule, of one severity."""

    rule: str
    severity: Severity
    count: int = 0
    packages: int = 0
    example: str = ""
    excess: float = 0.0
    tags: tuple[str, ...] = ()
    path: str = ""

    def counted(self) -> RuleCount:
        """Return the group as the count of a rule."""
        return RuleCount(
            self.rule, self.severity, self.count, self.count, self.example, self.tags, self.excess, path=self.path
        )


_Groups: TypeAlias = dict[tuple[str, Severity], RuleGroup]


def rule_groups(
    packages: Iterable[PackageSummary],
    findings: Iterable[Finding],
    tags: TagFilter,
    rules: Mapping[str, RuleInfo],
    changes: Mapping[str, int],
) -> list[RuleGroup]:
    """Return the findings that count, by rule and severity: most severe first, mistakes before limits, most urgent.

    Args:
        packages: summaries of packages.
        findings: those of no package.
        tags: which are meant.
        rules: what rules are about, by id.
        changes: in how many commits of the last year files changed.
    """
    groups: _Groups = {}
    for package in packages:
        _add_package(groups, package, tags)
    for finding in findings:
        _add_finding(groups, finding)

    def order(group: RuleGroup) -> tuple[int, bool, float, int, str]:
        soon = urgency(group.counted(), rules.get(group.rule), changes.get(group.path, 0))
        return -group.severity.rank, METRICS in group.tags, -soon, -group.count, group.rule

    return sorted(groups.values(), key=order)


def _add_package(groups: _Groups, package: PackageSummary, tags: TagFilter) -> None:
    seen: set[tuple[str, Severity]] = set()
    for rule in package.rules:
        if not rule.gated or not tags.matches(rule.tags):
            continue
        key = (rule.rule, rule.severity)
        group = groups.setdefault(key, RuleGroup(*key))
        group.count += rule.gated
        group.tags = rule.tags
        group.packages += key not in seen and package.id != OUTSIDE_PACKAGES
        if not group.example or rule.excess > group.excess:
            group.example, group.excess, group.path = rule.example, rule.excess, rule.path
        seen.add(key)


def _add_finding(groups: _Groups, finding: Finding) -> None:
    key = (finding.rule, finding.severity)
    group = groups.setdefault(key, RuleGroup(*key))
    group.count += 1
    if not group.example:
        place = f"{finding.path}:{finding.line}" if finding.line else finding.path or finding.entity
        group.example, group.path = (f"{place}: {finding.message}" if place else finding.message), finding.path


class Listing(msgspec.Struct, frozen=True):
    """Which groups are listed, and which are only counted.

    Attributes:
        listed: rule by rule.
        limits: that are little exceeded, where something else is listed.
        notes: where something else is listed.
    """

    listed: Sequence[RuleGroup]
    limits: Sequence[RuleGroup]
    notes: Sequence[RuleGroup]


def listing(groups: Sequence[RuleGroup]) -> Listing:
    """Return which of the groups are listed."""
    # Notes show where to look, not what to correct: they are listed where there is nothing else.
    grave = [group for group in groups if group.severity is not Severity.NOTE]
    notes = [group for group in groups if group.severity is Severity.NOTE] if grave else []
    # Slightly exceeded limits only show where to look as well, if there are mistakes to correct.
    meant = grave or groups
    worth = [group for group in meant if is_listed(group.counted())]
    limits = [group for group in meant if group not in worth] if worth else []
    return Listing(worth or meant, limits, notes)
