"""Which parts of a tally can be true: what cannot is refused as unknown, never taken for a value."""

from __future__ import annotations

import math

import msgspec

from roslens.model.traffic.tally import NOTHING, Moments, Tally

MAX_TEXT = 65_536
"""Characters of a name; a longer one is no name of ROS."""


def plausible_tally(tally: Tally) -> Tally | None:
    """Return a tally whose every part can be true, the rest of it as unknown; None where nothing can be kept.

    Its stretch has to be finite and not negative, counts not negative, times between messages not negative. Latency
    and age may be negative, because clocks differ between hosts.
    """
    period, latency, age, processing = tally.period, tally.latency, tally.age, tally.processing
    # One sum shows whether all are finite, at a tenth of the cost of testing each.
    total = (
        tally.start
        + tally.end
        + tally.first
        + tally.last
        + tally.longest_at
        + period.total
        + period.squares
        + period.greatest
    )
    if latency.count:
        total += latency.total + latency.squares + latency.least + latency.greatest
    if age.count:
        total += age.total + age.squares + age.least + age.greatest
    if processing.count:
        total += processing.total + processing.squares + processing.least + processing.greatest
    if (
        total - total == 0.0
        and tally.end >= tally.start
        and (tally.first == 0.0 or tally.start - 1 <= tally.first <= tally.last <= tally.end + 1)
        and tally.count >= period.count >= 0 <= period.least <= period.greatest
        and latency.count >= 0 <= age.count
        and processing.count >= 0
        and processing.least >= 0
        and tally.bytes >= -1 <= tally.lost
        and len(tally.topic) + len(tally.publisher) + len(tally.subscriber) <= MAX_TEXT
    ):
        return tally
    return _cleaned(tally)


def _cleaned(tally: Tally) -> Tally | None:
    start, end = tally.start, tally.end
    if not (math.isfinite(start) and math.isfinite(end) and end >= start and tally.count >= 0):
        return None
    if len(tally.topic) + len(tally.publisher) + len(tally.subscriber) > MAX_TEXT:
        return None
    timed = tally.count > 0 and start - 1 <= tally.first <= tally.last <= end + 1
    period = _moments(tally.period, least=0.0)
    return msgspec.structs.replace(
        tally,
        bytes=max(tally.bytes, -1),
        lost=max(tally.lost, -1),
        first=tally.first if timed else 0.0,
        last=tally.last if timed else 0.0,
        period=period if period.count <= tally.count else NOTHING,
        latency=_moments(tally.latency),
        age=_moments(tally.age),
        processing=_moments(tally.processing, least=0.0),
        longest_at=tally.longest_at if math.isfinite(tally.longest_at) else 0.0,
    )


def _moments(moments: Moments, least: float = -math.inf) -> Moments:
    total = moments.total + moments.squares + moments.least + moments.greatest
    if moments.count <= 0 or not math.isfinite(total) or not least <= moments.least <= moments.greatest:
        return NOTHING
    return moments
