"""Times between hosts, corrected by how far their clocks are apart, or unknown where that is not known well enough.

A latency is the receiver's clock minus the publisher's, so the difference of their offsets is in it. The stamp in a
header may come from a third host that nobody names: an age is not corrected, but is unknown where clocks differ.
"""

from __future__ import annotations

import msgspec

from roslens.model.entity import EntityKind
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import NOTHING, Moments, Tally

USUAL_TOLERANCE_S = 0.01
"""The accepted error of a time that no constraint limits."""


class HostClocks:
    """The latest offset of each host's clock to the monitor's, and its bound."""

    def __init__(self) -> None:
        self._clocks: dict[str, tuple[float, float]] = {}

    def take(self, sample: Sample) -> None:
        """Take the report of a host on its clock."""
        offset, bound = sample.values.get("clock_offset"), sample.values.get("clock_bound")
        if sample.entity.kind is EntityKind.HOST and offset is not None and bound is not None:
            self._clocks[sample.entity.name] = (offset, bound)

    @property
    def several(self) -> bool:
        """Whether more clocks than one are known; with one there is nothing to correct."""
        return len(self._clocks) > 1

    def corrected(self, tally: Tally, sender: str, receiver: str, tolerance: float) -> Tally:
        """Return the tally with times as one clock would show them.

        Args:
            tally: as its observer tells it.
            sender: host of the publisher; empty where unknown, which may then be any.
            receiver: host on which it was received; empty where unknown.
            tolerance: seconds that a time may be wrong; unknown where it may be more.
        """
        if (sender and sender == receiver) or not (tally.latency.count or tally.age.count):
            return tally
        ahead, bound = self._difference(sender, receiver)
        latency = _shifted(tally.latency, -ahead) if bound <= tolerance else NOTHING
        if latency.count and latency.least < -(bound + tolerance):
            latency = NOTHING  # nothing arrives before it is sent: a clock was set since its offset was reported
        age = tally.age if abs(ahead) + bound <= tolerance else NOTHING
        return msgspec.structs.replace(tally, latency=latency, age=age)

    def _difference(self, sender: str, receiver: str) -> tuple[float, float]:
        """Return how far the receiver's clock is ahead of the sender's, and how wrong that may be."""
        theirs, ours = self._between(sender), self._between(receiver)
        return (ours[0] + ours[1] - theirs[0] - theirs[1]) / 2, (ours[1] - ours[0] + theirs[1] - theirs[0]) / 2

    def _between(self, host: str) -> tuple[float, float]:
        """Return the least and greatest offset that a host may have."""
        if not self._clocks or (host and host not in self._clocks):
            return -float("inf"), float("inf")
        found = [self._clocks[host]] if host else list(self._clocks.values())
        return min(offset - bound for offset, bound in found), max(offset + bound for offset, bound in found)


def _shifted(moments: Moments, by: float) -> Moments:
    count, total, squares, least, greatest = (
        moments.count, moments.total, moments.squares, moments.least, moments.greatest,
    )  # fmt: skip
    if not count or not by:
        return moments
    return Moments(
        count, total + count * by, max(squares + 2 * by * total + count * by * by, 0.0), least + by, greatest + by
    )
