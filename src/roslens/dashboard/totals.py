"""Where a file belongs, and how often a rule was broken in all packages."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

import msgspec

from roslens.model.finding import Severity
from roslens.model.result import RuleCount
from roslens.model.source import SourceFile, number_of_packages
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.report.run.fix_first import Gravity, gravity


class FilePlace(msgspec.Struct, frozen=True):
    """A file and the package it belongs to."""

    package: str
    file: SourceFile


class RuleTotal(msgspec.Struct, frozen=True):
    """How often a rule was broken in all packages, and in how many; ``weight`` is the gravest that this had."""

    rule: str
    severity: Severity
    weight: tuple[Consequence, Certainty]
    tags: tuple[str, ...]
    count: int
    gated: int
    packages: int


def totals_of(counts: Iterable[tuple[str, RuleCount]]) -> tuple[RuleTotal, ...]:
    """Return the totals of each rule and severity: the gravest first, then the most frequent in own code.

    Args:
        counts: of rules, each with the id of its package.
    """
    groups: dict[tuple[str, Severity], list[tuple[str, RuleCount]]] = defaultdict(list)
    for owner, count in counts:
        groups[count.rule, count.severity].append((owner, count))
    totals = [
        RuleTotal(
            rule,
            severity,
            max((one.weight for _, one in found), key=_ranks),
            tuple(dict.fromkeys(tag for _, one in found for tag in one.tags)),
            count=sum(one.count for _, one in found),
            gated=sum(one.gated for _, one in found),
            packages=number_of_packages({owner for owner, _ in found}),
        )
        for (rule, severity), found in groups.items()
    ]
    return tuple(sorted(totals, key=_order))


def _ranks(weight: tuple[Consequence, Certainty]) -> tuple[int, int]:
    return weight[0].rank, weight[1].rank


def _order(one: RuleTotal) -> tuple[Gravity, int, int, str]:
    return gravity(one), -one.gated, -one.count, one.rule


def by_rule(totals: Iterable[RuleTotal], packages: Mapping[str, int]) -> tuple[RuleTotal, ...]:
    """Return one total a rule, of the gravest of its severities: the gravest first, then the most frequent in own code.

    Args:
        totals: of each rule and severity, the gravest first.
        packages: in how many packages each rule is broken, in whatever severity.
    """
    found: dict[str, RuleTotal] = {}
    for one in totals:
        first = found.get(one.rule, msgspec.structs.replace(one, count=0, gated=0))
        found[one.rule] = msgspec.structs.replace(
            first, count=first.count + one.count, gated=first.gated + one.gated, packages=packages[one.rule]
        )
    return tuple(sorted(found.values(), key=_order))
