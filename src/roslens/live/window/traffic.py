"""Signals of one window: rate, gaps, sizes and times from its tallies."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from operator import attrgetter

from roslens.live.window.bucket import Bucket
from roslens.live.window.window import Window
from roslens.model.traffic.tally import Moments, Observer

_BURST_S = 1e-3
"""Messages within less than this, of which nothing before and behind is seen, are one burst and show no rate."""
Measure = Callable[[Window], "float | None"]


def rate(window: Window) -> float | None:
    """Return messages per second: times between messages by their sum, so that the edges of the window do not matter.

    The silence at the end counts as soon as it is longer than every time between messages. Steady traffic is exact
    this way, bursts do not make the rate swing, and a topic that fell silent fades to 0 within the window. A silence
    that a tap may have made itself shows nothing: None where there is nothing else.
    """
    intervals = window.intervals
    quiet = window.quiet if window.quiet >= window.doubted_s else 0.0
    if intervals:
        # Its numbers say how many more were sent than a tap itself took.
        intervals += missed_by_tap(window)
        span = window.span
        if quiet * intervals > span:
            span += max(quiet - longest_interval(window), 0.0)
        return intervals / span if span > _BURST_S else None
    if quiet >= window.length:
        return 0.0
    if window.count and not any(bucket.first for bucket in window.buckets):
        covered = window.horizon - window.buckets[0].start
        return window.count / covered if covered > 0 else None
    return 1 / quiet if window.last and not window.count and quiet > 0 else None


def missed_by_tap(window: Window) -> int:
    """Return how many messages a tap lost itself; 0 for any other observer."""
    return sum(bucket.lost for bucket in window.buckets) if window.observer is Observer.TAP else 0


def period(window: Window) -> float | None:
    """Return the mean time between messages."""
    return window.span / (window.intervals + missed_by_tap(window)) if window.intervals else None


def jitter(window: Window) -> float | None:
    """Return the standard deviation of the times between messages; of those that a tap missed some of it is unknown."""
    if missed_by_tap(window):
        return None
    count, total, squares = 0, 0.0, 0.0
    for bucket in window.buckets:
        moments = bucket.period
        if moments.count:
            count += moments.count
            total += moments.total
            squares += moments.squares
    if count <= 1:
        return None
    mean = total / count
    return float(max(squares / count - mean * mean, 0.0) ** 0.5)


def longest_interval(window: Window) -> float:
    """Return the longest time between messages that ended in the window; -1 where none is known."""
    longest = -1.0
    for bucket in window.buckets:
        if bucket.gap > longest:
            longest = bucket.gap
    return longest


def longest_gap(window: Window, now: float) -> tuple[float, float]:
    """Return the longest time without a message, and when it began on the clock of the monitor, where it is ``now``."""
    gap, began = -1.0, 0.0
    for bucket in window.buckets:
        if bucket.gap > gap:
            gap, began = bucket.gap, bucket.gap_began
    if window.quiet > gap:
        gap, began = window.quiet, window.horizon - window.quiet
    # Up to its horizon a window was observed; it is looked at a moment later.
    return gap, now - window.late(now) - max(window.horizon - began, 0.0)


def largest_gap(window: Window) -> float | None:
    """Return the longest time without a message, the one that goes on included."""
    gap = longest_interval(window)
    quiet = window.quiet
    if quiet < window.doubted_s or (missed_by_tap(window) and quiet < window.length):
        return None
    if quiet <= gap:
        return gap
    # Counts alone give no gaps, unless the silence is longer than the window.
    if quiet < window.length and ((gap < 0 and window.count > 1) or not window.last):
        return None
    return quiet


def message_size(window: Window) -> float | None:
    """Return the mean size of those messages whose size is known."""
    return window.bytes / window.sized if window.sized else None


def bandwidth(window: Window) -> float | None:
    """Return bytes per second: mean size times rate."""
    hertz = rate(window)
    if hertz == 0.0:
        return 0.0
    size = message_size(window)
    return None if size is None or hertz is None else size * hertz


def loss(window: Window) -> float | None:
    """Return the share of messages that did not arrive, in percent; what a tap loses, nobody else has lost."""
    losses = window.losses() if window.observer is not Observer.TAP else None
    return None if losses is None else 100 * losses[0] / (losses[0] + losses[1])


def _mean_of(field: str) -> Measure:
    take = attrgetter(field)

    def mean(window: Window) -> float | None:
        count, total = 0, 0.0
        for bucket in window.buckets:
            moments = take(bucket)
            if moments.count:
                count += moments.count
                total += moments.total
        return total / count if count else None

    return mean


def _greatest_of(field: str) -> Measure:
    take = attrgetter(field)

    def greatest(window: Window) -> float | None:
        found = [moments.greatest for bucket in window.buckets if (moments := take(bucket)).count]
        return max(found, default=None)

    return greatest


MEASURES: dict[str, Measure] = {
    "rate": rate,
    "period": period,
    "jitter": jitter,
    "largest_gap": largest_gap,
    "bandwidth": bandwidth,
    "message_size": message_size,
    "latency": _mean_of("latency"),
    "latency_max": _greatest_of("latency"),
    "age": _mean_of("age"),
    "age_max": _greatest_of("age"),
    "loss": loss,
    "processing": _mean_of("processing"),
}
"""By key of the signal; each returns None if the window has no data for it."""


def measured(window: Window, key: str) -> float | None:
    """Return a signal of a window as it was last brought to an instant; each is measured once."""
    cache = window.cache
    if key not in cache:
        cache[key] = MEASURES[key](window)
    return cache[key]


def _per_second(total: float, bucket: Bucket) -> float | None:
    length = bucket.end - bucket.start
    return total / length if length > 0 else None


def _single(bucket: Bucket, key: str) -> float | None:
    """Return the value of one tally."""
    plain = _OF_ONE.get(key)
    if plain is not None:
        return plain(bucket)
    field, _, greatest = key.partition("_")
    moments: Moments = getattr(bucket, "period" if field == "jitter" else field)
    if greatest:
        return moments.greatest if moments.count else None
    return moments.deviation if field == "jitter" else moments.mean


def _rate_of_one(bucket: Bucket) -> float | None:
    return _per_second(bucket.count, bucket)


def _bandwidth_of_one(bucket: Bucket) -> float | None:
    return _per_second(bucket.bytes, bucket) if bucket.sized or not bucket.count else None


def _size_of_one(bucket: Bucket) -> float | None:
    return bucket.bytes / bucket.sized if bucket.sized else None


def _loss_of_one(bucket: Bucket) -> float | None:
    sent = bucket.lost + bucket.losable
    return 100 * bucket.lost / sent if bucket.losses_counted and sent else None


def _gap_of_one(bucket: Bucket) -> float | None:
    return bucket.gap if bucket.gap >= 0 else None


_OF_ONE: dict[str, Callable[[Bucket], float | None]] = {
    "rate": _rate_of_one,
    "bandwidth": _bandwidth_of_one,
    "message_size": _size_of_one,
    "loss": _loss_of_one,
    "largest_gap": _gap_of_one,
}


def percentile(values: Sequence[float], share: float) -> float | None:
    """Return the least value that ``share`` percent of the values do not exceed (nearest rank)."""
    if not values:
        return None
    ordered = sorted(values)
    return ordered[max(math.ceil(len(ordered) * share / 100), 1) - 1]


def percentile_of(window: Window, key: str, share: float) -> float | None:
    """Return a percentile of the values that the tallies of the window have one by one."""
    if key == "rate" and window.horizon > window.until and not window.count:
        return rate(window)
    found = [value for bucket in window.buckets if (value := _single(bucket, key)) is not None]
    return percentile(found, share)
