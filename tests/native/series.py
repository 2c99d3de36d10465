"""The four series of a slot: of the times between messages, of latencies, ages and processing times."""

from __future__ import annotations

from roslens.live.inside.snapshot import Snapshot


def series(one: Snapshot) -> list[tuple[float, float, float]]:
    """Return count, sum and sum of squares of each."""
    values = one.moments
    return [(values[at], values[at + 1], values[at + 2]) for at in range(0, len(values), 3)]
