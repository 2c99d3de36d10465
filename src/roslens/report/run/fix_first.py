"""Which findings to fix first: few, the gravest, surest, newest and in the files that change most."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Protocol

import msgspec

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.tags import TagFilter
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.store.summary import example_of

MOST = 10
OF_ONE_RULE = 3
"""Rows of one rule at most: more of them are one decision, not several."""
LIMITS = 1
"""Rows of quality models at most, which come last: what to change in such a function is for the reader to see."""
METRICS = "metrics"
"""The tag of findings of quality models."""
DISTRIBUTION = "distribution"
DEPRECATED = "deprecated"
"""Tags of findings about names that a distribution renamed, removed or is about to."""
FURTHEST = 16.0
"""How far beyond a limit is far: a limit of which nothing is that far beyond is for whoever looks at the metrics."""

_OF_PACKAGE = re.compile(r"`([\w-]+)")
"""A name, up to what parts it from that of its package."""
_FOLDERS = re.compile(r"(?:[\w.+-]+/)+")
_DIFFERENT = re.compile(r"`[^`]*`|'[^']*'|\b\d+\b|, here and \d+ times more|; expected .*", re.DOTALL)
"""What differs between messages of one kind: names, code, numbers, and the advice."""

Gravity = tuple[int, int, int, int]
Urgency = tuple[int, int, int, int, int, float, int, str, str]


def first_to_fix(
    packages: Iterable[PackageSummary],
    findings: Iterable[Finding],
    rules: Mapping[str, RuleInfo],
    tags: TagFilter,
    changes: Mapping[str, int] | None = None,
    grave: Sequence[Finding] = (),
) -> tuple[RuleCount, ...]:
    """Return at most :data:`MOST` findings, each as the count of its rule with itself as its example.

    They are ordered as :func:`urgency` says, but no two of one rule stand beside each other where another is left.
    Notes are left out. A line that two rules report is one row: that of the graver, with the ids of the others in
    ``also``.

    Args:
        packages: summaries, whose examples are the worst of each rule.
        findings: those of no package.
        rules: what rules are about, by id.
        tags: which findings are meant.
        changes: number of commits of the last year by file; nothing is known of others.
        grave: all findings with a grave consequence, of which summaries have examples alone.
    """
    whole = {finding.rule for finding in grave}
    counts = [
        one
        for package in packages
        for one in package.rules
        if one.gated and tags.matches(one.tags) and not (one.rule in whole and one.weight[0].grave)
    ]
    alone = [finding for finding in findings if not (finding.rule in whole and finding.weight[0].grave)]
    counts += [counted(one) for one in (*grave, *alone) if one.gated and tags.matches(one.tags)]
    known = changes or {}
    meant = [one for one in counts if one.severity is not Severity.NOTE and one.example]
    ordered = sorted(meant, key=lambda one: urgency(one, rules.get(one.rule), known.get(one.path, 0)))
    return _chosen(_one_a_line(ordered))


def new_before_others(new: Sequence[RuleCount], others: Sequence[RuleCount]) -> tuple[RuleCount, ...]:
    """Return at most :data:`MOST` findings to fix first, those that are new since a baseline before all others."""
    known = {(one.rule, one.example) for one in new}
    return (*new, *(one for one in others if (one.rule, one.example) not in known))[:MOST]


def is_listed(one: RuleCount) -> bool:
    """Return whether a row of a list names something to fix: a mistake, or a limit that is exceeded by far.

    No row reports what is too little: it cannot be less than nothing.
    """
    return METRICS not in one.tags or (one.excess >= FURTHEST and not one.rule.endswith(".min"))


class Weighed(Protocol):
    """A finding, or several of a rule, of which it is known what follows from them."""

    @property
    def tags(self) -> tuple[str, ...]: ...  # noqa: D102 - as findings have them

    @property
    def severity(self) -> Severity: ...  # noqa: D102

    @property
    def weight(self) -> tuple[Consequence, Certainty]: ...  # noqa: D102


def gravity(one: Weighed) -> Gravity:
    """Return a key that sorts by consequence, certainty and severity, the gravest first, limits of metrics last."""
    consequence, certainty = one.weight
    return METRICS in one.tags, -consequence.rank, -certainty.rank, -one.severity.rank


def urgency(one: RuleCount, rule: RuleInfo | None = None, commits: int = 0) -> Urgency:
    """Return a key that sorts by consequence, certainty, severity, recent commits and precision, limits last.

    Args:
        one: the count of a rule, with its example.
        rule: what the rule is about.
        commits: to the file of the example in the last year.
    """
    is_limit = METRICS in one.tags
    # What is too little cannot be less than nothing: the ratio is not informative.
    excess = 0.0 if one.rule.endswith(".min") else one.excess
    precision = rule.precision if rule is not None and rule.precision else 0.0
    return (
        *gravity(one),
        -commits,
        -excess if is_limit else -precision,
        -one.count,
        one.rule,
        one.example,
    )


def by_urgency(findings: Iterable[Finding]) -> list[Finding]:
    """Return findings in the order in which they are to be fixed: those that do not count behind all that do."""

    def order(one: Finding) -> tuple[object, ...]:
        *key, rule, _example = urgency(counted(one))
        return not one.gated, *key, one.path, one.line, one.column, rule

    return sorted(findings, key=order)


def counted(finding: Finding) -> RuleCount:
    """Return a single finding as the count of its rule."""
    return RuleCount(
        finding.rule,
        finding.severity,
        1,
        1,
        example_of(finding),
        finding.tags,
        finding.excess,
        path=finding.path,
        consequence=finding.consequence,
        certainty=finding.certainty,
        line=finding.line,
    )


def _one_a_line(ordered: Iterable[RuleCount]) -> list[RuleCount]:
    """Return rows of which each place has one, the first, with the other rules that report it.

    A place of which the same is said as of another is none but counts as one that is ``alike``: that is one decision.
    """
    found: dict[tuple[str, int, str], RuleCount] = {}
    said: dict[tuple[str, ...], tuple[str, int, str]] = {}
    for one in ordered:
        # Nothing but a line tells that two findings are about the same.
        key = (one.path, one.line, "") if one.path and one.line else ("", 0, f"{one.rule} {one.example}")
        first = found.get(key)
        if first is None:
            alike = next((said[what] for what in _said(one) if what in said), None)
            if alike is None:
                found[key] = one
                said.update(dict.fromkeys(_said(one), key))
            else:
                found[alike] = msgspec.structs.replace(found[alike], alike=found[alike].alike + 1)
        elif one.rule != first.rule and one.rule not in first.also:
            found[key] = msgspec.structs.replace(first, also=(*first.also, one.rule))
    return list(found.values())


def _said(one: RuleCount) -> Iterator[tuple[str, ...]]:
    """Yield what a row has in common with others that say the same.

    For the same file in a copy of its folder it is the file with the two folders around it, and the message without
    others; where it is no more than hard to maintain, the message alone: that ten packages have no licence is one
    decision, and each of ten mistakes at run time is one. So is a name that is gone wherever it is used, and with it
    the others that a distribution took from the same package: they are moved in one go. What one file has several
    times, but for names, is looked at in one go too.
    """
    message = one.example.removeprefix(one.path).lstrip(":0123456789 ") if one.path else one.example
    if one.weight[0].rank <= Consequence.HARD_TO_MAINTAIN.rank or DEPRECATED in one.tags:
        yield one.rule, message
    if DISTRIBUTION in one.tags and (name := _OF_PACKAGE.search(message)):
        yield one.rule, name[1]
    if one.path:
        yield one.rule, one.path, _DIFFERENT.sub("", message)
    *_, outer, inner, file = ("", "", "", *one.path.split("/"))
    if outer:
        yield one.rule, outer, inner, file, _FOLDERS.sub("", message)


def _chosen(ordered: Sequence[RuleCount]) -> tuple[RuleCount, ...]:
    """Return the first, at most a few of one rule, and no two of one rule beside each other while others are left."""
    waiting = [one for one in ordered if METRICS not in one.tags]
    used: Counter[str] = Counter()
    rows: list[RuleCount] = []
    while waiting and len(rows) < MOST:
        last = rows[-1].rule if rows else ""
        place = next((at for at, one in enumerate(waiting) if one.rule != last), 0)
        one = waiting.pop(place)
        rows.append(one)
        used[one.rule] += 1
        if used[one.rule] == OF_ONE_RULE:
            waiting = [other for other in waiting if other.rule != one.rule]
    # A limit is never the first thing to fix: where there is nothing else the list of findings has them.
    limits = [one for one in ordered if METRICS in one.tags][:LIMITS] if rows else []
    return tuple(rows[: MOST - len(limits)] + limits)
