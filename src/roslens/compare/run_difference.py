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


class MovedPackage(msgspec.Struct, frozen=True):
    """A package that both runs have, in another folder each, maybe of another repository; paths below the root."""

    package: str
    before: str
    after: str


class RunDifference(msgspec.Struct, frozen=True):
    """What only one of two runs has.

    Attributes:
        findings: new, gone and moved ones, of those that count for gates.
        added: ids of packages that only the later run has.
        removed: ids of packages that only the earlier run has.
        moved: packages that are in another folder.
        values: of packages that both have, by package and quantity.
        measured_by: what measured or judged differently: name, before, after.
    """

    findings: FindingDifference
    added: tuple[str, ...]
    removed: tuple[str, ...]
    moved: tuple[MovedPackage, ...]
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
    moved = tuple(MovedPackage(one, old[one].path, new[one].path) for one in both if old[one].path != new[one].path)
    # What git found of single files is more specific than the move of their package.
    renamed = {**_with_packages(moved, gated[0], old), **(renamed or {})}
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
        moved,
        tuple(values),
        made_by,
    )


def _with_packages(
    moved: Sequence[MovedPackage], findings: Sequence[Finding], packages: Mapping[str, PackageSummary]
) -> dict[str, str]:
    """Return the later path, by the earlier one, of files with findings in packages that moved as a whole."""
    found = {}
    for path in {one.path for one in findings if one.path} if moved else ():
        held = [one for one in packages.values() if _inside(path, one.path) is not None]
        innermost = max(held, key=lambda one: 0 if one.path == "." else len(one.path), default=None)
        for one in moved:
            if innermost is not None and one.package == innermost.id:
                inside = _inside(path, one.before)
                found[path] = str(inside) if one.after in ("", ".") else f"{one.after}/{inside}"
    return found


def _inside(path: str, folder: str) -> str | None:
    """Return a path as seen from a folder, which is ``.`` for the root; None where it is not in it."""
    if folder in ("", "."):
        return path
    return path[len(folder) + 1 :] if path.startswith(f"{folder}/") else None
