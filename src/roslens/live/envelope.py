"""When a tally cannot change any verdict, so that nothing has to be judged because of it.

Every value that is judged lies between the least and the greatest of what the tallies of a window say one by one:
rates, mean sizes and mean times are means with positive weights, gaps and extremes are maxima. So as long as each
tally lies inside all bounds, the window does too. Jitter is bounded by the root of the mean square distance to any
fixed period, which is a mean again; a bandwidth is split into a rate and a size whose product is fine; and a sum over
publishers into the share that each has now.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import inf, sqrt

from roslens.live.bucket import Bucket
from roslens.live.connection import Connection
from roslens.live.measured import Group
from roslens.live.topic import SUMMED, Topic
from roslens.live.traffic import bandwidth, message_size, period, rate
from roslens.live.window import Window

_MEANS = ("latency", "age", "processing")


class Envelope:
    """Bounds of a single tally of a connection.

    Attributes:
        rate: least and greatest messages per second.
        size: of the mean size of a message in bytes.
        gap: the longest time without a message.
        centre: the period from which distances are taken.
        scatter: the greatest mean square of these.
        loss: least and greatest share, in percent.
        means: by number of the series, where it is bounded: least and greatest mean, and greatest value.
    """

    __slots__ = (
        "centre", "gap", "loss", "means", "rate", "scatter", "size",
    )  # fmt: skip

    def __init__(self) -> None:
        self.rate = (0.0, inf)
        self.size: tuple[float, float] | None = None
        self.gap = inf
        self.centre = 0.0
        self.scatter = inf
        self.loss: tuple[float, float] | None = None
        self.means: dict[str, tuple[float, float, float]] = {}

    def holds(self, bucket: Bucket) -> bool:
        """Whether a bucket lies inside all bounds, and the silence at its end too."""
        intervals = bucket.intervals
        if not intervals or not bucket.count:
            return False
        span, gap = bucket.span, bucket.gap
        low, high = self.rate
        quiet = bucket.end - bucket.last
        if gap > self.gap or quiet > self.gap or intervals > high * span:
            return False
        if intervals < low * (span + quiet - gap if quiet > gap else span):
            return False
        if self.scatter < inf:
            moments = bucket.period
            count = moments.count
            if not count:
                return False
            centre = self.centre
            if moments.squares - centre * (2 * moments.total - centre * count) > self.scatter * count:
                return False
        size = self.size
        if size is not None and not size[0] * bucket.sized <= bucket.bytes <= size[1] * bucket.sized != 0:
            return False
        for field, (low, high, greatest) in self.means.items():
            moments = getattr(bucket, field)
            count = moments.count
            if not count or not low * count <= moments.total <= high * count or moments.greatest > greatest:
                return False
        return self.loss is None or self._loss_holds(bucket)

    def _loss_holds(self, bucket: Bucket) -> bool:
        sent = bucket.lost + bucket.losable
        if not bucket.losses_counted or not sent or self.loss is None:
            return False
        return self.loss[0] <= 100 * bucket.lost / sent <= self.loss[1]

    def narrow(self, group: Group, window: Window, share: float) -> bool:
        """Take the bounds of sentences, of which this connection has a ``share``; False where that cannot be done."""
        key, low, high = group.key, group.low, group.high
        if group.percentile:
            return False
        if key in SUMMED:
            low, high = low * share, high * share
        if key == "rate":
            self._narrow_rate(low, high)
        elif key == "period":
            self._narrow_rate(1 / high if high > 0 else inf, 1 / low if low > 0 else inf)
        elif key == "bandwidth":
            return self._narrow_bandwidth(low, high, window)
        elif key == "message_size":
            self._narrow_size(low, high)
        elif key == "largest_gap":
            self.gap = min(self.gap, high)
            return low <= 0
        elif key == "jitter":
            self.centre = period(window) or 0.0
            self.scatter = min(self.scatter, high * high)
            return low <= 0
        elif key == "loss":
            known = self.loss or (-inf, inf)
            self.loss = max(known[0], low), min(known[1], high)
        else:
            return self._narrow_mean(key, low, high)
        return True

    def _narrow_rate(self, low: float, high: float) -> None:
        self.rate = max(self.rate[0], low), min(self.rate[1], high)

    def _narrow_size(self, low: float, high: float) -> None:
        known = self.size or (-inf, inf)
        self.size = max(known[0], low), min(known[1], high)

    def _narrow_bandwidth(self, low: float, high: float, window: Window) -> bool:
        hertz, size, value = rate(window), message_size(window), bandwidth(window)
        if not hertz or not size or not value:
            return False
        if high < inf:
            room = sqrt(high / value)
            self._narrow_rate(-inf, hertz * room)
            self._narrow_size(-inf, size * room)
        if low > 0:
            room = sqrt(low / value)
            self._narrow_rate(hertz * room, inf)
            self._narrow_size(size * room, inf)
        return True

    def _narrow_mean(self, key: str, low: float, high: float) -> bool:
        field, _, extreme = key.partition("_")
        if field not in _MEANS:
            return False
        least, most, greatest = self.means.get(field, (-inf, inf, inf))
        if extreme:
            self.means[field] = least, most, min(greatest, high)
            return low == -inf
        self.means[field] = max(least, low), min(most, high), greatest
        return True


def envelope_of(connection: Connection, topic: Topic) -> Envelope | None:
    """Return what a tally of a connection has to be so that no verdict about it or its topic changes.

    None where a verdict is not fine, or where what its windows hold now is not all inside, for what leaves them
    changes their values too.
    """
    alone = connection.alone
    if alone is None or connection.gone or (topic.judged and not topic.calm):
        return None
    envelope = Envelope()
    groups: Iterable[tuple[Group, float]] = [(group, 1.0) for group in connection.groups]
    shares: dict[str, float | None] = {}
    for group in topic.groups:
        if group.key in ("publishers", "subscribers"):
            continue
        if group.key in SUMMED and group.key not in shares:
            shares[group.key] = _share(connection, topic, group)
        share = shares.get(group.key, 1.0)
        if share is None:
            return None
        groups = [*groups, (group, share)]
    for group, share in groups:
        window = alone[group.at]
        if not group.calm or not envelope.narrow(group, window, share):
            return None
    if all(envelope.holds(bucket) for window in alone for bucket in window.buckets):
        return envelope
    return None


def _share(connection: Connection, topic: Topic, group: Group) -> float | None:
    """Return which part of a sum over publishers is from that of a connection."""
    if len(topic.connections) == 1:
        return 1.0
    for one, _ in topic.views(group.at):
        if one.publisher == connection.publisher:
            value, _ = one.value(group.key, group.at)
            return value / group.value if value and group.value else None
    return None
