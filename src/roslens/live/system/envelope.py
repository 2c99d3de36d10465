"""When a tally cannot change any verdict, so that nothing has to be judged because of it.

Every value that is judged lies between the least and the greatest of what the tallies of a window say one by one:
rates, mean sizes and mean times are means with positive weights, gaps and extremes are maxima. So as long as each
tally lies inside all bounds, the window does too. Jitter is bounded by the root of the mean square distance to any
fixed period, which is a mean again; a bandwidth is split into a rate and a size whose product is fine; and a sum over
publishers into the share that each has now.
"""

from __future__ import annotations

from math import inf, sqrt

from roslens.live.standing.measured import Group
from roslens.live.window.bucket import Bucket, Series
from roslens.live.window.own_gaps import LARGE_BYTES
from roslens.live.window.round import Round
from roslens.live.window.signals import RECEIVED, SUMMED
from roslens.live.window.traffic import bandwidth, message_size, period, rate
from roslens.live.window.window import EPSILON_S, Window
from roslens.model.traffic.tally import NOTHING, Observer, Tally
from roslens.model.traffic.tally_columns import Row, tally_of

_BEFORE = -EPSILON_S
_Bounds = tuple[float, float, float]
_BOUNDLESS = (-inf, inf, inf)
_ANY_SIZE = (-inf, inf)
_MEANS = ("latency", "age", "processing")


class Envelope:
    """Bounds of a single tally of a connection with one observer.

    Attributes:
        slow: least messages per second.
        fast: greatest of them.
        size: of the mean size of a message in bytes.
        gap: the longest time without a message.
        centre: the period from which distances are taken.
        scatter: the greatest mean square of these.
        loss: least and greatest share, in percent.
        boundless: whether nothing is judged of the connection.
        most_lost: messages. What a tap loses itself raises the rate, and leaves gaps and jitter unknown.
        latency: least and greatest mean, and greatest value; None where it has no bounds.
        age: those of it.
        processing: those of it.
        windows: of the connection.
        round: in which the newest tally inside came; None where that was noticed.
    """

    __slots__ = (
        "age", "boundless", "centre", "fast", "gap", "latency", "loss", "most_lost", "processing", "round", "scatter",
        "size", "slow", "windows",
    )  # fmt: skip

    def __init__(self, windows: list[Window]) -> None:
        self.boundless = True
        self.slow, self.fast = 0.0, inf
        self.size = _ANY_SIZE
        self.gap = inf
        self.centre = 0.0
        self.scatter = inf
        self.loss: tuple[float, float] | None = None
        self.latency: _Bounds | None = None
        self.age: _Bounds | None = None
        self.processing: _Bounds | None = None
        self.most_lost = 0 if windows[0].observer is Observer.TAP else inf
        self.windows = windows
        self.round: Round | None = None

    def takes(self, row: Row, now: Round) -> bool:
        """Put a tally into the windows that is plausible, follows the last one, and lies inside; else return False.

        What is asked is never true of a value that is no number. Long, because a call costs as much as ten questions.
        """
        windows = self.windows
        window = windows[0]
        start, end, count, size, first, last, period, latency, age, lost, observer, _, processing, longest_at = row
        if not count:
            return self._takes_pause(tally_of("", row), now)
        until = window.until
        hole, length, quiet = start - until, end - until, end - last
        gap, span, squares, centre = period.greatest, period.total, period.squares, self.centre
        if not (
            _BEFORE <= hole <= window.spacing
            and length > EPSILON_S
            and period.count == count > 0 <= period.least <= gap <= self.gap >= quiet
            and self.slow * span <= count <= self.fast * span
            and self.slow * (span + quiet - gap) <= count
            and squares - centre * (span + span - centre * count) <= self.scatter * count
            and size >= -1
            and self.size[0] * count <= size <= self.size[1] * count
            and -1 <= lost <= self.most_lost
            and start - 1 <= first <= last <= end + 1
            and observer is window.observer
        ):
            return False
        finite = squares + gap + end + longest_at
        if latency.count or self.latency is not None:
            finite += _within(latency, self.latency)
        if age.count or self.age is not None:
            finite += _within(age, self.age)
        if processing.count or processing.least or self.processing is not None:
            finite += _within_from_zero(processing, self.processing)
        if self.loss is not None:
            finite += _loss_within(lost, count, self.loss)
        if finite - finite != 0:
            return False
        for window in windows:
            if not window.buckets:  # all of it is over, as after frames that came late
                return False
        self._begin_round(now)
        for window in windows:
            window.follow_row(row, length, hole)
        return True

    def _takes_pause(self, tally: Tally, now: Round) -> bool:
        """Put a tally without messages into the windows that follows one with some, and is too short to matter.

        A topic whose messages come about as often as tallies has one now and then. What the last messages before it
        say outweighs the silence since. A second one is looked at.
        """
        nothing = tally.period == tally.latency == tally.age == tally.processing == NOTHING
        if not nothing or self.loss is not None or tally.first or tally.last or tally.longest_at:
            return False
        window = self.windows[0]
        hole, length = tally.start - window.until, tally.end - window.until
        follows = _BEFORE <= hole <= window.spacing and EPSILON_S < length < inf and tally.observer is window.observer
        if not follows or tally.bytes not in (-1, 0) or tally.lost not in (-1, 0):
            return False
        if not all(self._outweighs(window, tally.end) for window in self.windows):
            return False
        self._begin_round(now)
        for window in self.windows:
            window.follow(tally, length, hole)
        return True

    def _outweighs(self, window: Window, end: float) -> bool:
        """Whether the newest messages of a window keep its values inside all bounds with the silence up to ``end``."""
        if self.boundless:
            return True
        newest = window.buckets[-1] if window.buckets else None
        if newest is None or not newest.count or not newest.intervals or not window.last:
            return False
        quiet = end - window.last
        return 0 <= quiet <= self.gap and self.slow * (newest.span + max(quiet - newest.gap, 0.0)) <= newest.intervals

    def _begin_round(self, now: Round) -> None:
        if now is not self.round:
            self.notice()
            self.round = now

    def notice(self) -> None:
        """Let windows know when the newest tally inside was noticed; nothing is known of one since the last tick."""
        if self.round is not None and self.round.time is not None:
            for window in self.windows:
                if window.news:
                    window.notice(self.round.time)
            self.round = None

    def lets_be(self, bucket: Bucket) -> bool:
        """Whether a bucket that is followed by others lies inside all bounds, or has no messages and says nothing."""
        if bucket.count or bucket.intervals or bucket.lost:
            return self.holds(bucket)
        return self.loss is None

    def holds(self, bucket: Bucket) -> bool:
        """Whether a bucket lies inside all bounds, and the silence at its end too."""
        intervals = bucket.intervals
        if not intervals or not bucket.count:
            return False
        span, gap = bucket.span, bucket.gap
        quiet = bucket.end - bucket.last
        if gap > self.gap or quiet > self.gap or intervals > self.fast * span or bucket.lost > self.most_lost:
            return False
        if intervals < self.slow * (span + quiet - gap if quiet > gap else span):
            return False
        if self.scatter < inf and not self._scatter_holds(bucket.period):
            return False
        size = self.size
        if size is not _ANY_SIZE and not size[0] * bucket.sized <= bucket.bytes <= size[1] * bucket.sized != 0:
            return False
        for field in _MEANS:
            bounds = getattr(self, field)
            if bounds is not None and _within(getattr(bucket, field), bounds) == inf:
                return False
        return self.loss is None or self._loss_holds(bucket)

    def _scatter_holds(self, moments: Series) -> bool:
        count, centre = moments.count, self.centre
        return bool(count) and moments.squares - centre * (2 * moments.total - centre * count) <= self.scatter * count

    def _loss_holds(self, bucket: Bucket) -> bool:
        sent = bucket.lost + bucket.losable
        if not bucket.losses_counted or not sent or self.loss is None:
            return False
        return self.loss[0] <= 100 * bucket.lost / sent <= self.loss[1]

    def narrow(self, group: Group, window: Window, share: float) -> bool:
        """Take the bounds of constraints, of which this connection has a ``share``; False where that cannot be done."""
        self.boundless = False
        key, low, high = group.key, group.low, group.high
        if group.percentile:
            return False
        if key in SUMMED:
            low, high = low * share, high * share
        if key in ("rate", RECEIVED):
            self._narrow_rate(low, high)
        elif key == "period":
            self._narrow_rate(1 / high if high > 0 else inf, 1 / low if low > 0 else inf)
        elif key == "bandwidth":
            return self._narrow_bandwidth(low, high, window)
        elif key == "message_size":
            self._narrow_size(low, high)
        elif key == "largest_gap":
            self._narrow_gap(high)
            return low <= 0
        elif key == "jitter":
            self.centre = period(window) or 0.0
            self.scatter = min(self.scatter, high * high)
            return low <= 0
        elif key == "loss":
            self._narrow_loss(low, high)
        else:
            return self._narrow_mean(key, low, high)
        return True

    def _narrow_gap(self, high: float) -> None:
        self.gap = min(self.gap, high)
        if not self.most_lost:
            # Larger messages raise the silence that a tap may have made itself.
            self.size = self.size[0], min(self.size[1], LARGE_BYTES)

    def _narrow_loss(self, low: float, high: float) -> None:
        least, most = self.loss or (-inf, inf)
        self.loss = max(least, low), min(most, high)

    def _narrow_rate(self, low: float, high: float) -> None:
        self.slow, self.fast = max(self.slow, low), min(self.fast, high)

    def _narrow_size(self, low: float, high: float) -> None:
        # What has no known size is -1 bytes long.
        self.size = max(self.size[0], low, 0.0), min(self.size[1], high)

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
        least, most, greatest = getattr(self, field) or (-inf, inf, inf)
        if extreme:
            setattr(self, field, (least, most, min(greatest, high)))
            return low == -inf
        setattr(self, field, (max(least, low), min(most, high), greatest))
        return True


def _within(series: Series, bounds: _Bounds | None) -> float:
    """Return a sum that is finite if a series is and lies inside its bounds, and infinite or no number if not."""
    count, total, greatest = series.count, series.total, series.greatest
    low, high, most = bounds or _BOUNDLESS
    if count > 0 and low * count <= total <= high * count and greatest <= most:
        return total + series.squares + series.least + greatest
    return inf


def _loss_within(lost: int, count: int, bounds: tuple[float, float]) -> float:
    """Return 0 if the share of what was lost, in percent, is known and lies inside its bounds, infinite if not."""
    return 0.0 if lost >= 0 and bounds[0] <= 100 * lost / (lost + count) <= bounds[1] else inf


def _within_from_zero(series: Series, bounds: _Bounds | None) -> float:
    """Return the same of a series in which nothing is below zero."""
    return _within(series, bounds) if series.least >= 0 else inf
