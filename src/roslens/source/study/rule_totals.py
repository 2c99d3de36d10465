"""Which rules are broken most, in how many packages, and by role."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from roslens.model.study import Broken, RuleTotal


def rule_totals(broken: Iterable[Broken]) -> tuple[RuleTotal, ...]:
    """Return a total for each rule, the most frequent first."""
    counts: Counter[tuple[str, str]] = Counter()
    packages: dict[tuple[str, str], set[str]] = {}
    by_role: dict[tuple[str, str], Counter[str]] = {}
    for one in broken:
        key = (one.rule, one.kind)
        counts[key] += one.count
        packages.setdefault(key, set()).add(one.package)
        by_role.setdefault(key, Counter())[one.role] += one.count
    totals = [
        RuleTotal(rule, kind, count, len(packages[rule, kind]), dict(sorted(by_role[rule, kind].items())))
        for (rule, kind), count in counts.items()
    ]
    return tuple(sorted(totals, key=lambda one: (-one.count, one.rule)))
