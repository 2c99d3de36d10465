"""What is new since the run before: by which findings of this one are distinguished from those that were there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

from roslens.compare.finding_difference import FindingDifference, finding_difference
from roslens.model.finding import Finding

Key = tuple[str, str, str, int]


class SinceRun:
    """A run against the one that was kept before it; compared on demand, and once."""

    def __init__(
        self, name: str, before: Callable[[], Sequence[Finding]], now: Callable[[], Sequence[Finding]]
    ) -> None:
        """Take what the earlier run is called (``run 4``), and what gives the findings of both."""
        self.name = name
        self._before = before
        self._now = now

    @cached_property
    def _difference(self) -> FindingDifference:
        old, new = ([one for one in found if one.gated] for found in (self._before(), self._now()))
        return finding_difference(old, new)

    @cached_property
    def _keys(self) -> frozenset[Key]:
        return frozenset(map(_key, self._difference.new))

    @property
    def added(self) -> int:
        """How many findings that count for gates this run has and that one had not."""
        return len(self._difference.new)

    @property
    def resolved(self) -> int:
        """How many that one had and this run has not."""
        return len(self._difference.gone)

    def is_new(self, finding: Finding) -> bool:
        """Return whether only this run has a finding; of those that do not count for gates none is new."""
        return _key(finding) in self._keys


def _key(finding: Finding) -> Key:
    return finding.rule, finding.path, finding.fingerprint, finding.line
