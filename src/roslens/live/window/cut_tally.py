"""A part of a tally: what came after an instant."""

from __future__ import annotations

from roslens.model.traffic.tally import Tally


def cut(tally: Tally, start: float, count: int, share: float) -> Tally:
    """Return a tally that begins later; its times between messages stay, as they are per message."""
    first = tally.first if tally.first >= start else 0.0
    return Tally(
        tally.topic,
        tally.publisher,
        tally.subscriber,
        start,
        tally.end,
        count,
        round(tally.bytes * share) if tally.bytes >= 0 else -1,
        first,
        tally.last if first or tally.last >= start else 0.0,
        tally.period if share == 1.0 else type(tally.period)(),
        tally.latency,
        tally.age,
        round(tally.lost * share) if tally.lost >= 0 else -1,
        tally.observer,
        tally.host,
        tally.processing,
        tally.longest_at,
    )
