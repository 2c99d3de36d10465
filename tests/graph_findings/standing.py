"""What was measured of each coding rule since it was mended last, and whether that is as much as is wanted."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from graph_findings.judgements import Sample
from graph_findings.mendings import Mending, read_mendings

READ = 20
"""Findings of a rule that are read, unless fewer exist."""
SPREAD = 10
"""Repositories that they are of."""
BOUND = 0.9
"""The share of findings that are true at least."""


class Standing(msgspec.Struct, frozen=True):
    """What the tables that were drawn since a rule was mended say of it.

    Attributes:
        true: findings that were true.
        read: findings that were read.
        repositories: of how many repositories these are.
        whole: findings in the tables of which every one of the rule was read; the last table is one of them, else 0.
        looked_at: repositories of these tables; 0 where the last table was not read in full.
    """

    true: int = 0
    read: int = 0
    repositories: int = 0
    whole: int = 0
    looked_at: int = 0

    @property
    def sampled(self) -> bool:
        """Whether enough findings of enough repositories were read."""
        return self.read >= READ and self.repositories >= SPREAD

    @property
    def counted(self) -> bool:
        """Whether there are some and every one of the last table was read, so that no sample can say more."""
        return self.looked_at > 0 and self.whole > 0

    @property
    def absent(self) -> bool:
        """Whether the last table has none, nor was any read before."""
        return self.looked_at > 0 and not self.read

    @property
    def met(self) -> bool:
        """Whether as much was read as is wanted."""
        return self.sampled or self.counted


def standing_of(rule: str, mending: Mending | None, found: Mapping[str, Sample]) -> Standing:
    """Return what is known of a rule as it is.

    Args:
        rule: its id.
        mending: when it was mended last; None is never.
        found: all tables, by name.

    Raises:
        KeyError: there is no table of the name that the mending says.
    """
    last = -1 if mending is None else found[mending.after].seed
    tables = sorted(
        (one for one in found.values() if one.seed > last and not one.developed_on and one.looks_at(rule)),
        key=lambda one: one.seed,
    )
    rows = {one.seed: [row for row in one.findings if row.rule == rule and row.verdict is not None] for one in tables}
    read = [row for every in rows.values() for row in every]
    # That a table has none says nothing of a rule that came later; of the last one all rules were looked at.
    whole = [one for one in tables if len(rows[one.seed]) == one.population.get(rule, 0) > 0]
    if tables and tables[-1] not in whole and not tables[-1].population.get(rule, 0):
        whole.append(tables[-1])
    some = [one for one in tables if one.population.get(rule, 0)]
    if not tables or tables[-1] not in whole or (some and some[-1] not in whole):
        whole = []  # more exist than were read, where there were any last
    return Standing(
        sum(bool(row.verdict) for row in read),
        len(read),
        len({row.repository for row in read}),
        sum(one.population.get(rule, 0) for one in whole),
        len({name for one in whole for name in one.repositories.keys() - one.not_read.keys()}),
    )


def enough(found: Mapping[str, Sample]) -> list[str]:
    """Return the rules of which enough findings were read since they were mended, and enough of them are true."""
    mendings = read_mendings()
    rules = sorted({row.rule for one in found.values() for row in one.findings})
    known = {rule: standing_of(rule, mendings.get(rule), found) for rule in rules}
    return [rule for rule, one in known.items() if one.sampled and one.true >= BOUND * one.read]
