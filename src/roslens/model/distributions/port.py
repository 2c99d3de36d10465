"""What of a workspace changes when it moves from one distribution of ROS to another."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.model.finding import Finding
from roslens.model.weight.consequence import Consequence


class Port(msgspec.Struct, frozen=True, omit_defaults=True):
    """What a port concerns, each part by place.

    Attributes:
        before: name of the distribution that the workspace is for.
        after: name of the one that it is to be for.
        breaks: what ``before`` has and ``after`` has not.
        deprecated: what ``after`` still has, and ``before`` did not yet deprecate.
        already: what ``before`` has not either.
    """

    before: str
    after: str
    breaks: tuple[Finding, ...] = ()
    deprecated: tuple[Finding, ...] = ()
    already: tuple[Finding, ...] = ()

    @property
    def fixable(self) -> int:
        """How many of the places that break have a fix."""
        return sum(bool(one.edits) for one in (*self.breaks, *self.already))

    def by_consequence(self) -> dict[Consequence, tuple[Finding, ...]]:
        """Return what breaks by what follows from it, worst first."""
        found: dict[Consequence, list[Finding]] = {}
        for one in self.breaks:
            found.setdefault(one.weight[0], []).append(one)
        return {key: tuple(found[key]) for key in sorted(found, key=lambda one: -one.rank)}


def port_between(before: str, after: str, had: Iterable[Finding], has: Iterable[Finding]) -> Port:
    """Return what a port concerns.

    Args:
        before: name of the distribution that the workspace is for.
        after: name of the one that it is to be for.
        had: findings of the rules on distributions with ``before`` as the target.
        has: the same with ``after``.
    """
    known = {_place(one): _is_broken(one) for one in had}
    breaks: list[Finding] = []
    deprecated: list[Finding] = []
    already: list[Finding] = []
    for one in sorted(has, key=lambda one: (one.path, one.line, one.column, one.rule, one.message)):
        earlier = known.get(_place(one))
        if _is_broken(one):
            (already if earlier else breaks).append(one)
        elif earlier is None:
            deprecated.append(one)
    return Port(before, after, tuple(breaks), tuple(deprecated), tuple(already))


def _place(finding: Finding) -> tuple[str, str, int, int, str]:
    return finding.rule, finding.path, finding.line, finding.column, finding.fingerprint


def _is_broken(finding: Finding) -> bool:
    """Return whether the target does not have what is used: what it only deprecates builds and starts."""
    return finding.weight[0].grave
