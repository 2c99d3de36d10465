"""A connection: the reports of its observers on the traffic from one publisher to one subscriber over one topic."""

from __future__ import annotations

from roslens.live.standing.measured import Measured
from roslens.live.standing.verdict_state import NEVER
from roslens.live.system.connection_name import connection_id
from roslens.live.system.envelope import Envelope
from roslens.live.window.observer_rank import RANK
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.traffic import MEASURES, Measure, measured, percentile_of
from roslens.live.window.window import MAX_BUCKETS, Window
from roslens.model.traffic.tally import Observer, Tally

_LATE_S, _SHARE_OF_LATE, _LONGEST_STEP_S = 2.0, 0.1, 1.0
"""What an observer tells later than that is noticed later still by this share, by no more than a second."""
_PAUSE_S = 0.5
"""Seconds after a tally outside its envelope until a connection gets another."""
_INSTANT_S = 1e-9
"""A look comes rather this early than too late by a rounding."""
AUTOMATIC = (0.0,)


class Connection(Measured):
    """The windows of a connection, one for each observer and each length that a constraint asks for.

    Attributes:
        topic: its name.
        publisher: empty where unknown.
        subscriber: empty of traffic seen at the publisher.
        host: on which its observer stands.
        gone: whether the graph lacks an end of it.
        envelope: what its tallies have to be so that nothing has to be judged; None where every tally has to be.
        patience: until when no envelope is looked for, because there was none.
    """

    __slots__ = (
        "_by_observer",
        "_lengths",
        "_most",
        "_order",
        "_sole",
        "envelope",
        "gone",
        "host",
        "patience",
        "publisher",
        "settled",
        "subscriber",
        "topic",
    )

    def __init__(self, topic: str, publisher: str, subscriber: str, now: float) -> None:
        super().__init__(connection_id(topic, publisher, subscriber), now)
        self.topic = topic
        self.publisher = publisher
        self.subscriber = subscriber
        self.host = ""
        self.gone = False
        self.envelope: Envelope | None = None
        self.patience = -NEVER
        self.seen = True
        self.settled = -NEVER
        self._lengths: tuple[float, ...] = AUTOMATIC
        self._most = MAX_BUCKETS
        self._by_observer: dict[Observer, list[Window]] = {}
        self._sole: Observer | None = None
        self._order: list[list[Window]] = []

    def add(self, tally: Tally, now: float, observer_status: ObserverStatus | None = None) -> bool:
        """Take a tally that is plausible, reported by ``observer_status``; return whether it reported anything new."""
        envelope = self.envelope
        if envelope is not None:
            self.catch_up()
        if tally.observer is self._sole:
            windows = self._order[0]
        else:
            windows = self._by_observer.get(tally.observer) or self._observed(tally)
        first = windows[0]
        if first.observer_status is not observer_status and observer_status is not None:
            for window in windows:
                window.observer_status = observer_status
        until = first.until
        news = False
        for window in windows:
            news |= window.add(tally, now)
        if (
            self.envelope is not None
            and news
            and (first.until <= until or not all(self.envelope.holds(window.buckets[-1]) for window in windows))
        ):
            self.envelope = None
            self.patience = now + _PAUSE_S
        return news

    def wake(self) -> None:
        """Look at every tally from now on."""
        self.catch_up()
        self.envelope = None

    def catch_up(self) -> None:
        """Inform the windows of when data came that was not evaluated yet."""
        if self.envelope is not None:
            self.envelope.notice()

    def resize(self, lengths: tuple[float, ...], most: int) -> None:
        """Keep a window of each of these lengths, of at most so many buckets."""
        self.wake()
        if (lengths, most) == (self._lengths, self._most):
            return
        self._most = most
        for observer, windows in self._by_observer.items():
            by_length = dict(zip(self._lengths, windows, strict=True))
            kept = []
            for length in lengths:
                window = by_length.get(length) or _copy(max(windows, key=lambda one: one.length), length)
                window.resize(most)
                kept.append(window)
            self._by_observer[observer] = kept
        self._lengths = lengths
        self._sort()

    def notice(self, envelope: Envelope, now: float) -> bool:
        """Note when news came to a connection with an envelope; False where it is silent for too long."""
        envelope.notice()
        windows = self._order[0]
        first = windows[0]
        if first.news:
            for window in windows:
                window.notice(now)
        self.due = first.noticed + first.patience - _INSTANT_S
        return self.due > now

    def settle(self, now: float) -> None:
        """Bring every window to ``now``."""
        if self.settled == now:
            return
        self.settled = now
        self.catch_up()
        for windows in self._order:
            for window in windows:
                window.settle(now)
                if window.stepped:
                    window.stepped = False
                    self.appeared = now

    def resume(self, time: float) -> None:
        """Be judged again from ``time``: earlier data is no evidence about later data."""
        self.appeared = time
        self.clear(time)
        self.due = time

    def clear(self, now: float) -> None:
        """Forget all traffic, because time broke."""
        self.appeared = now
        self.envelope = None
        for windows in self._order:
            for window in windows:
                window.clear()

    def value(self, key: str, at: int, percentile: float = 0.0) -> tuple[float | None, Window | None]:
        """Return a signal and the window it is from: that of the best observer that reports and has it."""
        measure = MEASURES.get(key)
        if measure is None:
            return None, None
        if len(self._order) > 1 or percentile:
            return self._of_best(measure, key, at, percentile)
        window = self._order[0][at]
        if not window.spacing or window.observer_silent:
            return None, None
        return measured(window, key), window

    def _of_best(self, measure: Measure, key: str, at: int, percentile: float) -> tuple[float | None, Window | None]:
        """Return a signal of the best of several observers; of one that is behind only if no other has it."""
        stale: tuple[float | None, Window | None] = (None, None)
        for windows in self._order:
            window = windows[at]
            if not window.spacing or window.observer_silent:
                continue
            value = percentile_of(window, key, percentile) if percentile else measure(window)
            if value is None:
                stale = stale if stale[1] else (None, window)
            elif window.horizon == window.until:
                return value, window
            elif stale[0] is None:
                stale = (value, window)
        return stale

    def speaks(self, at: int) -> Window | None:
        """Return the window of its only observer, where that one speaks; None where it is silent, or there are more."""
        if len(self._order) != 1:
            return None
        window = self._order[0][at]
        return window if window.spacing and not window.observer_silent else None

    def best(self, at: int) -> Window | None:
        """Return the window of the best observer who speaks; of those who fell silent where all did."""
        self.catch_up()
        quiet = None
        for windows in self._order:
            window = windows[at]
            if window.spacing and not window.observer_silent:
                if window.horizon == window.until:
                    return window
                quiet = quiet or window
        return quiet

    @property
    def newest(self) -> list[Window]:
        """The first window of each observer, of the best first: what the latest values are taken from."""
        return [windows[0] for windows in self._order]

    @property
    def quiet_since(self) -> float | None:
        """When the monitor noticed the last tally of all, None where it noticed none."""
        self.catch_up()
        noticed = [windows[0].noticed for windows in self._order if windows[0].spacing]
        return max(noticed, default=None)

    @property
    def silent_observer(self) -> ObserverStatus | None:
        """An observer of it, if all that observe it are silent."""
        statuses = [windows[0].observer_status for windows in self._order if windows[0].spacing]
        if statuses and all(observer_status is not None and observer_status.silent for observer_status in statuses):
            return statuses[0]
        return None

    def reported_by(self, observer_status: ObserverStatus) -> bool:
        """Whether an observer reports it."""
        return any(windows[0].observer_status is observer_status for windows in self._order)

    @property
    def empty(self) -> bool:
        """Whether no window has anything."""
        return not any(window.buckets for windows in self._order for window in windows)

    @property
    def alone(self) -> list[Window] | None:
        """The windows of the only observer; None where there are several."""
        return self._order[0] if len(self._order) == 1 else None

    @property
    def left(self) -> bool:
        """Whether it ended: the graph lacks an end of it, and nothing comes any more."""
        if not self.gone:
            return False
        window = self.best(0)
        return window is None or not window.count or window.horizon > window.until

    def next_due(self, now: float) -> float:
        """Return when silence alone may change something."""
        due = NEVER
        for windows in self._order:
            for window in windows:
                if window.spacing:
                    due = min(due, _due(window, now))
        return due

    def _observed(self, tally: Tally) -> list[Window]:
        self.envelope = None
        if tally.host and not self.host:
            self.host = tally.host
        windows = [Window(tally.observer, tally.host, length, self._most) for length in self._lengths]
        self._by_observer[tally.observer] = windows
        self._sort()
        return windows

    def _sort(self) -> None:
        self._sole = next(iter(self._by_observer)) if len(self._by_observer) == 1 else None
        self._order = [self._by_observer[one] for one in sorted(self._by_observer, key=RANK.__getitem__)]


def _due(window: Window, now: float) -> float:
    patient = window.noticed + window.patience - _INSTANT_S
    if now < patient:
        return patient
    over = window.noticed + window.length + (window.until - (window.last or window.begun))
    step = min(max(window.length / 20, 0.05), 0.095)
    if window.observer_status is not None:
        if window.observer_status.silent:
            return NEVER
        behind = window.observer_status.behind(now)
        over += behind
        # As long as its observer does not report that it has looked, time alone changes nothing.
        if behind > _LATE_S:
            step = max(step, min(_SHARE_OF_LATE * behind, _LONGEST_STEP_S))
    return now + step if now <= over + step else NEVER


def _copy(source: Window, length: float) -> Window:
    """Return a window of another length that knows what one knows already."""
    window = Window(source.observer, source.host, length)
    # Each window merges its own buckets.
    window.take_over(source, [bucket.twin() for bucket in source.buckets])
    return window
