"""Two runs of one workspace, side by side: findings, packages and what was measured of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.compare.finding_difference import FindingDifference, finding_difference
from roslens.model.finding import Finding
from roslens.model.result import PackageSummary
from roslens.model.source import OUTSIDE_PACKAGES


class ValueChange(msgspec.Struct, frozen=True):
    """A quantity of a package that is another; None on the side that has none."""

    package: str
    quantity: str
    before: float | None
    after: float | None


class RunDifference(msgspec.Struct, frozen=True):
    """What only one of two runs has.

    Attributes:
        findings: new, gone and moved ones, of those that count for gates.
        added: ids of packages that only the later run has.
        removed: ids of packages that only the earlier run has.
        values: of packages that both have, by package and quantity.
        measured_by: what measured or judged differently: name, before, after.
    """

    findings: FindingDifference
    added: tuple[str, ...]
    removed: tuple[str, ...]
    values: tuple[ValueChange, ...]
    measured_by: tuple[tuple[str, str, str], ...]


class RunSide(msgspec.Struct, frozen=True):
    """One of the two: its findings, packages, and the versions and models that measured and judged."""

    findings: Sequence[Finding]
    packages: Sequence[PackageSummary]
    made_by: Mapping[str, str]


def run_difference(before: RunSide, after: RunSide, renamed: Mapping[str, str] | None = None) -> RunDifference:
    """Return the difference.

    Args:
        before: the earlier run.
        after: the later run.
        renamed: files that have another path in the later run, by the earlier one.
    """
    old, new = ({one.id: one for one in side.packages if one.id != OUTSIDE_PACKAGES} for side in (before, after))
    gated = [[one for one in side.findings if one.gated] for side in (before, after)]
    both = sorted(old.keys() & new.keys())
    values = [
        ValueChange(package, key, old[package].values.get(key), new[package].values.get(key))
        for package in both
        for key in sorted(old[package].values.keys() | new[package].values.keys())
        if old[package].values.get(key) != new[package].values.get(key)
    ]
    made_by = tuple(
        (name, before.made_by[name], after.made_by[name])
        for name in sorted(before.made_by.keys() & after.made_by.keys())
        if before.made_by[name] != after.made_by[name]
    )
    return RunDifference(
        finding_difference(gated[0], gated[1], renamed),
        tuple(sorted(new.keys() - old.keys())),
        tuple(sorted(old.keys() - new.keys())),
        tuple(values),
        made_by,
    )
