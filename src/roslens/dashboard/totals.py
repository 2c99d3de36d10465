"""Where a file belongs, and how often a rule was broken in all packages."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec

from roslens.model.finding import Severity
from roslens.model.source import SourceFile


class FilePlace(msgspec.Struct, frozen=True):
    """A file and the package it belongs to."""

    package: str
    file: SourceFile


class RuleTotal(msgspec.Struct, frozen=True):
    """How often a rule was broken in all packages, and in how many."""

    rule: str
    severity: Severity
    tags: tuple[str, ...]
    count: int
    gated: int
    packages: int


def by_rule(totals: Iterable[RuleTotal], packages: Mapping[str, int]) -> tuple[RuleTotal, ...]:
    """Return one total a rule, of the gravest of its severities: most severe first, then most frequent in own code.

    Args:
        totals: of each rule and severity, most severe first.
        packages: in how many packages each rule is broken, in whatever severity.
    """
    found: dict[str, RuleTotal] = {}
    for one in totals:
        first = found.get(one.rule, msgspec.structs.replace(one, count=0, gated=0))
        found[one.rule] = msgspec.structs.replace(
            first, count=first.count + one.count, gated=first.gated + one.gated, packages=packages[one.rule]
        )
    return tuple(sorted(found.values(), key=lambda one: (-one.severity.rank, -one.gated, -one.count, one.rule)))
