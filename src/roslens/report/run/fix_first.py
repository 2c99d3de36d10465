"""Which findings to mend first: few, of different rules, the most severe, surest and furthest beyond their limit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import log2

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.tags import TagFilter

MOST = 3
METRICS = "metrics"
"""The tag of findings of quality models: one of them at most is named where there is something else to mend."""
UNMEASURED = 0.75
"""Share of true findings that is supposed of a rule whose precision nobody measured."""
LIMIT = 0.4
"""The same of a limit of a quality model: it is exceeded, but what to mend is for the reader to see."""
FURTHEST = 16.0
"""How far beyond a limit still counts: what is a thousand times beyond is no more urgent than that. A limit of which
nothing is that far beyond is for whoever looks at the metrics, not for whoever mends."""
BUSIEST = 31
"""Commits of a year beyond which a file is no busier. A file that changes often is read and broken often: at most 1.6
times as urgent as one that nobody touches, so that severity decides before it."""
_REACH = {"node": 1.2, "graph": 1.2, "cpp": 1.1, "python": 1.1, "launch": 1.1}
"""What happens on the robot goes before what happens where it is built, by the family of the rule."""
_WEIGHTS = {Severity.ERROR: 100.0, Severity.WARNING: 10.0, Severity.NOTE: 1.0}


def first_to_fix(
    packages: Iterable[PackageSummary],
    findings: Iterable[Finding],
    rules: Mapping[str, RuleInfo],
    tags: TagFilter,
    changes: Mapping[str, int] | None = None,
) -> tuple[RuleCount, ...]:
    """Return at most :data:`MOST` findings, each as the count of its rule with the worst as its example.

    Ordered by severity times the measured precision of the rule times where it shows times how far the limit is
    exceeded times how often the file changed lately; notes are left out, and of each rule only the worst is named.

    Args:
        packages: summaries, whose examples are the worst of each rule.
        findings: those of no package.
        rules: what rules are about, by id.
        tags: which findings are meant.
        changes: number of commits of the last year by file; nothing is known of others.
    """
    counts = [one for package in packages for one in package.rules if one.gated and tags.matches(one.tags)]
    counts += [_counted(finding) for finding in findings if finding.gated and tags.matches(finding.tags)]
    best: dict[str, tuple[float, RuleCount]] = {}
    for one in counts:
        if one.severity is Severity.NOTE or not one.example:
            continue
        score = urgency(one, rules.get(one.rule), (changes or {}).get(one.path, 0))
        if one.rule not in best or score > best[one.rule][0]:
            best[one.rule] = (score, one)
    ordered = [one for _, one in sorted(best.values(), key=lambda pair: (-pair[0], pair[1].rule))]
    limits = [one for one in ordered if METRICS in one.tags]
    rest = [one for one in ordered if METRICS not in one.tags]
    spared = set(limits[1:]) if len(rest) + 1 >= MOST else set(limits[MOST - len(rest) :])
    return tuple(one for one in ordered if one not in spared)[:MOST]


def new_before_others(new: Sequence[RuleCount], others: Sequence[RuleCount]) -> tuple[RuleCount, ...]:
    """Return at most :data:`MOST` findings to mend first, those that are new since a baseline before all others."""
    known = {(one.rule, one.example) for one in new}
    return (*new, *(one for one in others if (one.rule, one.example) not in known))[:MOST]


def is_listed(one: RuleCount) -> bool:
    """Return whether a row of a list tells what to mend: a mistake, or a limit that is exceeded by far.

    No row reports what is too little: it cannot be less than nothing.
    """
    return METRICS not in one.tags or (one.excess >= FURTHEST and not one.rule.endswith(".min"))


def urgency(one: RuleCount, rule: RuleInfo | None, commits: int = 0) -> float:
    """Return how soon a finding is to be mended: severity x precision x where it shows x excess x recent commits."""
    precision = LIMIT if METRICS in one.tags else UNMEASURED
    if rule is not None and rule.precision:
        precision = rule.precision
    # What is too little cannot be less than nothing: the ratio is not informative.
    excess = 1.0 if one.rule.endswith(".min") else min(max(one.excess, 1.0), FURTHEST)
    reach = _REACH.get(one.rule.partition(".")[0], 1.0)
    churn = 1 + log2(1 + min(commits, BUSIEST)) / 8
    return _WEIGHTS[one.severity] * precision * reach * (1 + log2(excess) / 4) * churn


def _counted(finding: Finding) -> RuleCount:
    place = f"{finding.path}:{finding.line}" if finding.line else finding.path or finding.entity
    example = f"{place}: {finding.message}" if place else finding.message
    return RuleCount(finding.rule, finding.severity, 1, 1, example, finding.tags, finding.excess, path=finding.path)
