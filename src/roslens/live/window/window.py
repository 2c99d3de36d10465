"""What one observer reported of one connection over the last seconds.

Everything inside is on the observer's clock, and only the time since its last news is taken from the monitor's: so a
clock that is hours away, or a tally that is always a second late, changes nothing.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from roslens.live.window.bucket import Bucket
from roslens.live.window.cut_tally import cut
from roslens.live.window.losses import Losses
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.own_gaps import OwnGaps
from roslens.model.traffic.tally import Observer, Tally
from roslens.model.traffic.tally_columns import Row

MAX_BUCKETS = 20
"""Neighbouring tallies are merged rather than to keep more than these."""
MAX_VALUES = 200
"""And more than these where percentiles of their values are asked for."""
DEFAULT_S = 2.0
"""Length of a window of which nothing is known."""
LONGEST_S = 60.0
"""To which a window grows by itself where the traffic is slow."""
PERIODS = 5
"""How many expected periods a window has to hold."""
BRIEF_S = 1.0
"""A window that is shorter holds two tallies at least, and those that reach into it as a whole."""
_GRAIN = 1.5
"""Neighbouring tallies share a bucket up to so many times its usual share of the window."""
EPSILON_S = 1e-6
"""Instants that are closer together are the same."""
_SLACK_S = 1.0
_STRANGE = 3
"""So many tallies in a row from another time are a stepped clock, fewer are mistakes."""


class Window:
    """The tallies of one observer of one connection, newest last.

    Attributes:
        observer: who saw it.
        host: on which the observer stands.
        additions: how often something late was put in between what was known.
        length: seconds that are kept.
        most: buckets that are kept.
        until: end of the newest tally, which only ever grows.
        last: when the last message came; 0 before the first. Clocks of simulations may be before 0.
        begun: start of the oldest tally since the observer appeared or its clock stepped.
        noticed: when the monitor noticed the newest tally, on its own clock.
        spacing: seconds from one tally to the next.
        lag: by how many seconds the newest tally came late, because it waited for a line.
        horizon: up to when the window reaches, on the observer's clock.
        quiet: seconds up to the horizon since the last message, or since the beginning where there was none.
        cache: signals by key, since the window was last brought to an instant.
        stepped: whether the observer's clock did, since somebody last asked.
        observer_status: of the observer, which has looked up to some time; None if it looks as long as the monitor.
        doubted_s: seconds of silence which a tap may have made itself by what it loses; 0 for any other observer.
    """

    __slots__ = (
        "_automatic",
        "_former",
        "_grain",
        "_least",
        "_own_gaps",
        "_strange",
        "_summed",
        "additions",
        "begun",
        "buckets",
        "bytes",
        "cache",
        "count",
        "doubted_s",
        "horizon",
        "host",
        "intervals",
        "lag",
        "last",
        "length",
        "most",
        "news",
        "noticed",
        "observer",
        "observer_status",
        "quiet",
        "sized",
        "spacing",
        "span",
        "stepped",
        "until",
    )

    def __init__(self, observer: Observer, host: str, length: float = 0.0, most: int = MAX_BUCKETS) -> None:
        """Begin an empty window of at most ``most`` buckets; a ``length`` of 0 is found by the traffic."""
        self.most = most
        self.observer = observer
        self.host = host
        self._automatic = not length
        self._least = 2 if 0 < length < BRIEF_S else 1
        self.length = length or DEFAULT_S
        self._grain = _GRAIN * self.length / most
        self._summed = True
        self.buckets: deque[Bucket] = deque()
        self.until = self.last = self.begun = self.noticed = self.horizon = self.spacing = self.span = self.quiet = 0.0
        self.count = self.intervals = self.bytes = self.sized = 0
        self.news = self.stepped = False
        self.observer_status: ObserverStatus | None = None
        self.lag = 0.0
        self.doubted_s = 0.0
        self._own_gaps = OwnGaps()
        self.additions = 0
        self.cache: dict[str, float | None] = {}
        self._strange: list[Tally] = []
        self._former = Losses()

    def add(self, tally: Tally, now: float) -> bool:
        """Take a tally; ``now`` is when the monitor last looked, on its clock. Return whether it holds anything new."""
        buckets = self.buckets
        until, spacing = self.until, self.spacing
        hole = tally.start - until
        if buckets and -EPSILON_S <= hole <= spacing and tally.end > until + EPSILON_S:
            self.follow(tally, tally.end - until, hole)
            return True
        if not spacing and not buckets:
            self._begin(tally)
            return True
        if tally.end <= until + EPSILON_S:
            return self._fill(tally) or self._stranger(tally, now)
        if hole > _SLACK_S + self.spacing and hole > _SLACK_S + self.spacing + now - self.noticed:
            return self._stranger(tally, now)
        if hole < -EPSILON_S:
            fresh = self._without_known(tally)
            if fresh is None:
                return False
            tally = fresh
        elif hole > self.spacing:
            # A pause of the observer is no measure of how often it usually reports.
            self.spacing = max(min(tally.end - until, 2 * self.spacing), 0.9 * self.spacing)
        if hole <= self.spacing:
            self.spacing = max(tally.end - until, 0.9 * self.spacing)
        if self._strange:
            self._strange.clear()
        self._append(Bucket.of(tally, self.last if hole <= _SLACK_S else 0.0))
        return True

    def follow(self, tally: Tally, length: float, hole: float) -> None:
        """Take what nearly every tally is: the one after the last, which ends ``length`` later, after a ``hole``."""
        spacing = 0.9 * self.spacing
        self.spacing = length if length > spacing else spacing  # noqa: FURB136
        if self._strange:
            self._strange.clear()
        newest = self.buckets[-1]
        previous = self.last if hole <= _SLACK_S else 0.0
        end = tally.end
        if end - newest.start > self._grain:
            self._append(Bucket.of(tally, previous))
            return
        newest.extend(tally, previous)
        last = tally.last
        self.until = end
        if last and (last > self.last or not self.last):
            self.last = last
        elif tally.count and not last:
            self.last = end
        self.news = True
        self._summed = False

    def follow_row(self, row: Row, length: float, hole: float) -> None:
        """Do what :meth:`follow` does, of a tally that counted messages and every time between them."""
        spacing = 0.9 * self.spacing
        self.spacing = length if length > spacing else spacing  # noqa: FURB136
        if self._strange:
            self._strange.clear()
        buckets = self.buckets
        newest = buckets[-1]
        known = self.last
        end, last = row[1], row[5]
        self.until = end
        if last > known or (last and not known):
            self.last = last
        elif not last:
            self.last = end
        self.news = True
        self._summed = False
        if end - newest.start <= self._grain:
            newest.extend_row(row, known if hole <= _SLACK_S else 0.0)
            return
        buckets.append(Bucket.of_row(row, known if hole <= _SLACK_S else 0.0))
        if len(buckets) > self.most:
            self._shrink()

    def notice(self, now: float) -> None:
        """Note when news came, without looking at it yet."""
        if self.news:
            self.news = False
            self.noticed = now
            self.lag = self.observer_status.lag if self.observer_status is not None else 0.0
            self.horizon = self.until
            if self._automatic:
                if not self._summed:
                    self._sum()
                if self.intervals:
                    self.length = min(max(self.length, PERIODS * self.span / self.intervals), LONGEST_S)
                    self._grain = _GRAIN * self.length / self.most

    def settle(self, now: float) -> None:
        """Look at the window at ``now`` on the monitor's clock: silence counts, what is too old goes."""
        if self.news:
            self.notice(now)
        else:
            waited = now - self.noticed
            if self.observer_status is not None:
                waited -= self.observer_status.behind(now) - self.lag
            self.horizon = self.until + (waited if waited > self.patience else 0.0)
        if self.cache:
            self.cache = {}
        horizon = self.horizon
        self.quiet = max(horizon - (self.last or self.begun), 0.0)
        if self.buckets and self.buckets[0].start < horizon - self.length - EPSILON_S:
            self._drop(horizon - self.length)
        if not self._summed:
            self._sum()
        if self.observer is Observer.TAP:
            self.doubted_s = self._own_gaps.doubted(self.buckets, horizon)

    @property
    def patience(self) -> float:
        """Seconds without news after which an observer is taken to have seen nothing."""
        return 1.5 * self.spacing + 0.05

    @property
    def observer_silent(self) -> bool:
        """Whether its observer is silent, so that the present traffic is unknown."""
        return self.observer_status is not None and self.observer_status.silent

    def late(self, now: float) -> float:
        """Return the seconds from its horizon to ``now`` on the monitor's clock."""
        if self.horizon == self.until:
            return now - self.noticed
        return self.observer_status.behind(now) if self.observer_status is not None else 0.0

    @property
    def silent(self) -> bool:
        """Whether no message came for longer than is usual."""
        return bool(self.spacing) and (not self.intervals or self.quiet * self.intervals > 2 * self.span)

    @property
    def filled(self) -> bool:
        """Whether the connection has been watched for as long as the window is."""
        return self.horizon - self.begun >= self.length - EPSILON_S

    def resize(self, most: int) -> None:
        """Keep at most so many buckets."""
        self.most = most
        self._grain = _GRAIN * self.length / most

    def take_over(self, source: Window, buckets: Iterable[Bucket]) -> None:
        """Know what another window of the same observer knows; ``buckets`` are its own."""
        self.observer_status, self.lag = source.observer_status, source.lag
        self.until, self.last, self.begun = source.until, source.last, source.begun
        self.noticed, self.spacing = source.noticed, source.spacing
        self.news, self.horizon = source.news, source.horizon
        self.buckets.extend(buckets)
        self._former = source._former.twin()
        self._summed = False

    def losses(self) -> tuple[int, int] | None:
        """Return how many messages were lost and how many came lately; None where that is not known."""
        return self._former.of(self.buckets, self.horizon)

    def clear(self) -> None:
        """Forget everything: time itself broke."""
        self.buckets.clear()
        self._former.clear()
        self.cache = {}
        self._strange.clear()
        self.count = self.intervals = self.bytes = self.sized = 0
        self.until = self.last = self.begun = self.spacing = self.span = self.doubted_s = 0.0
        self._own_gaps.clear()
        self._summed = True

    def _begin(self, tally: Tally) -> None:
        self.clear()
        self.begun = tally.start
        self.spacing = max(tally.end - tally.start, EPSILON_S)
        self._append(Bucket.of(tally, 0.0))

    def _append(self, bucket: Bucket) -> None:
        self.buckets.append(bucket)
        self._end(bucket.last, bucket.count, bucket.end)
        if len(self.buckets) > self.most:
            self._shrink()

    def _shrink(self) -> None:
        self._drop(self.until - self.length)
        if len(self.buckets) > self.most:
            self._merge()

    def _end(self, last: float, count: int, end: float) -> None:
        """Note how far the window reaches now."""
        self.until = end
        if last and (last > self.last or not self.last):
            self.last = last
        elif count and not last:
            self.last = end
        self.news = True
        self._summed = False

    def _sum(self) -> None:
        """Add up the buckets."""
        count = intervals = size = sized = 0
        span = 0.0
        for bucket in self.buckets:
            count += bucket.count
            intervals += bucket.intervals
            span += bucket.span
            size += bucket.bytes
            sized += bucket.sized
        self.count, self.intervals, self.span, self.bytes, self.sized = count, intervals, span, size, sized
        self._summed = True

    def _drop(self, before: float) -> None:
        buckets, least, former = self.buckets, self._least, self._former
        before -= EPSILON_S
        while buckets:
            oldest = buckets[0]
            if oldest.start >= before or (oldest.end > before and (least > 1 or len(buckets) == 1)):
                break
            if len(buckets) <= least and self.horizon == self.until:
                break
            former.keep(buckets.popleft())
            self._summed = False

    def _merge(self) -> None:
        """Merge neighbours in pairs."""
        merged: deque[Bucket] = deque()
        buckets = self.buckets
        while len(buckets) > 1:
            bucket = buckets.popleft()
            bucket.absorb(buckets.popleft())
            merged.append(bucket)
        merged.extend(buckets)
        self.buckets = merged

    def _fill(self, tally: Tally) -> bool:
        """Put a late tally where nothing is known yet; what is known already is a duplicate."""
        if tally.start < self.begun - EPSILON_S or not tally.count or tally.end <= self.until - self.length:
            return False
        for number, bucket in enumerate(self.buckets):
            if bucket.start >= tally.end - EPSILON_S:
                before = self.buckets[number - 1].end if number else self.begun
                if tally.start < before - EPSILON_S:
                    return False
                late = Bucket.of(tally, 0.0)
                self.buckets.insert(number, late)
                self.additions += 1
                self._summed = False
                return True
            if bucket.end > tally.start + EPSILON_S:
                return False
        return False

    def _without_known(self, tally: Tally) -> Tally | None:
        """Return the part of an overlapping tally that is new, None where that cannot be determined."""
        while self.buckets and self.buckets[-1].start >= tally.start - EPSILON_S:
            self.buckets.pop()
            self._summed = False
        known = self.buckets[-1].end if self.buckets else tally.start
        overlap = known - tally.start
        if overlap <= EPSILON_S:
            return tally
        share = (tally.end - known) / (tally.end - tally.start)
        if tally.count and tally.first and tally.first >= known - EPSILON_S:
            return cut(tally, known, tally.count, 1.0)
        return cut(tally, known, round(tally.count * share), share)

    def _stranger(self, tally: Tally, now: float) -> bool:
        """Keep a tally from another time aside; several in a row, and none from this, mean that a clock stepped."""
        strange = self._strange
        if self.until - self.length < tally.start <= self.until:
            return False
        if strange and tally.start < strange[-1].end - EPSILON_S:
            strange.clear()
        strange.append(tally)
        del strange[:-_STRANGE]
        if len(strange) < _STRANGE or self.news or now - self.noticed <= self.patience:
            return False
        known = list(strange)
        self._begin(known[0])
        self.stepped = True
        for one in known[1:]:
            self.spacing = max(one.end - self.until, self.spacing)
            self._append(Bucket.of(one, self.last))
        return True
