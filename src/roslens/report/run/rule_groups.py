"""Findings by rule and severity, in the order in which they are listed, and which of them are listed at all."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

import msgspec

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.tags import TagFilter
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.report.run.fix_first import Urgency, is_listed, urgency


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
    consequence: Consequence | None = None
    certainty: Certainty | None = None

    @property
    def weight(self) -> tuple[Consequence, Certainty]:
        """Consequence and certainty of the surest finding."""
        return self.counted().weight

    def counted(self) -> RuleCount:
        """Return the group as the count of a rule."""
        return RuleCount(
            self.rule,
            self.severity,
            self.count,
            self.count,
            self.example,
            self.tags,
            self.excess,
            path=self.path,
            consequence=self.consequence,
            certainty=self.certainty,
        )

    def weigh(self, consequence: Consequence | None, certainty: Certainty | None) -> None:
        """Take the weight of a finding if it is surer than that of those before."""
        if certainty is not None and (self.certainty is None or certainty.rank > self.certainty.rank):
            self.consequence, self.certainty = consequence, certainty


_Groups: TypeAlias = dict[tuple[str, Severity], RuleGroup]


def rule_groups(
    packages: Iterable[PackageSummary],
    findings: Iterable[Finding],
    tags: TagFilter,
    rules: Mapping[str, RuleInfo],
    changes: Mapping[str, int],
) -> list[RuleGroup]:
    """Return the findings that count, by rule and severity, in the order in which to fix them; notes are last.

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

    def order(group: RuleGroup) -> tuple[bool, Urgency]:
        soon = urgency(group.counted(), rules.get(group.rule), changes.get(group.path, 0))
        return group.severity is Severity.NOTE, soon

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
        group.weigh(rule.consequence, rule.certainty)
        group.packages += key not in seen and package.id != OUTSIDE_PACKAGES
        if not group.example or rule.excess > group.excess:
            group.example, group.excess, group.path = rule.example, rule.excess, rule.path
        seen.add(key)


def _add_finding(groups: _Groups, finding: Finding) -> None:
    key = (finding.rule, finding.severity)
    group = groups.setdefault(key, RuleGroup(*key))
    group.count += 1
    group.weigh(finding.consequence, finding.certainty)
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
    # Notes show where to look, not what to correct: they are listed where there is nothing else, or where they are
    # unproven and would be grave.
    meant = [group for group in groups if group.severity is not Severity.NOTE or group.weight[0].grave] or list(groups)
    notes = [group for group in groups if group not in meant]
    # Slightly exceeded limits only show where to look as well, if there are mistakes to correct.
    worth = [group for group in meant if is_listed(group.counted())]
    limits = [group for group in meant if group not in worth] if worth else []
    return Listing(worth or meant, limits, notes)
