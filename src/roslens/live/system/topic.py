"""A topic: the fold of its connections."""

from __future__ import annotations

from bisect import insort
from collections.abc import Iterable, Iterator, Sequence

from roslens.live.standing.measured import Measured
from roslens.live.system.connection import Connection
from roslens.live.window.observer_rank import RANK
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.signals import ENDS, RECEIVED, SUMMED
from roslens.live.window.traffic import measured
from roslens.live.window.window import MAX_BUCKETS, Window
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.tally import Observer

_WIDEST = frozenset({"jitter", "largest_gap"})
_OF_PUBLISHERS = SUMMED | _WIDEST | {"period", "message_size"}
_MEANS = frozenset({"latency", "age"})

_UNKNOWN: tuple[float | None, Window | None] = (None, None)
_AS_SENT = 0.9
"""What arrives at so large a share of what is sent arrives as it is sent, but for the edges of windows."""


class Topic(Measured):
    """The connections of a topic by publisher.

    Attributes:
        name: of the topic.
        connections: by publisher; that of unknown ones under the empty name.
        publishers: nodes that publish it, by the graph.
        former: those that did before the last of them went.
        subscribers: nodes that subscribe to it, by the graph.
        types: of its messages.
        known: whether the graph has it.
        more: publishers and subscribers beyond these names: several nodes of one name.
        misfits: pairs of nodes that exchange nothing over it; None where that is not known.
        lengths: of the windows that its constraints need.
        most: buckets that these keep.
    """

    __slots__ = (
        "_ordered",
        "connections",
        "former",
        "known",
        "lengths",
        "misfits",
        "more",
        "most",
        "name",
        "publishers",
        "subscribers",
        "types",
    )

    def __init__(self, name: str, now: float) -> None:
        super().__init__(EntityId(EntityKind.TOPIC, name), now)
        self.name = name
        self.connections: dict[str, list[Connection]] = {}
        self.publishers: frozenset[str] = frozenset()
        self.former: frozenset[str] = frozenset()
        self.subscribers: frozenset[str] = frozenset()
        self.types: frozenset[str] = frozenset()
        self.known = False
        self.more = (0, 0)
        self.misfits: int | None = None
        self.most = MAX_BUCKETS
        self.lengths: tuple[float, ...] = ()
        self._ordered: list[Connection] = []

    def add(self, connection: Connection) -> None:
        """Take a connection in."""
        self.connections.setdefault(connection.publisher, []).append(connection)
        insort(self._ordered, connection, key=_ends)
        self.seen = True

    def remove(self, connection: Connection) -> None:
        """Let a connection go."""
        group = self.connections[connection.publisher]
        group.remove(connection)
        self._ordered.remove(connection)
        if not group:
            del self.connections[connection.publisher]

    def tells_nothing(self, connection: Connection) -> bool:
        """Whether a connection changes no value as long as nothing is reported of it.

        That is what is left of traffic whose publisher was not known yet, once that is known: it would keep all others
        from resting.
        """
        return not connection.publisher and len(self.connections) > 1 and connection.empty

    def all_connections(self) -> list[Connection]:
        """Return every connection that is there, else every one, in order."""
        every = self._ordered
        return [one for one in every if not one.left] or [one for one in every if self._of_last(one)] or every

    def views(self, at: int) -> list[tuple[Connection, Window]]:
        """Return for each publisher where its traffic is seen best: subscribers of one publisher do not add up."""
        groups = self.connections
        if len(groups) == 1:
            (group,) = groups.values()
            if len(group) == 1:
                return _best(group, at)
        named = [group for publisher, group in sorted(groups.items()) if publisher]
        found: list[tuple[Connection, Window]] = []
        for group in named or groups.values():
            found += _best(group, at)
        if len(found) == 1:
            return found
        there = [(one, window) for one, window in found if not one.left]
        return there or [(one, window) for one, window in found if self._of_last(one)] or found

    def value(
        self, key: str, at: int, percentile: float = 0.0, views: list[tuple[Connection, Window]] | None = None
    ) -> tuple[float | None, Window | None]:
        """Return a signal of the topic and the window that has most of it; ``views`` are taken where known."""
        if key in ENDS:
            return self._of_graph(key, None), None
        if key == RECEIVED:
            return min(self._received(at, percentile).values(), key=_rate_of, default=_UNKNOWN)
        if key in _OF_PUBLISHERS:
            return _joined(
                key, (one.value(key, at, percentile) for one, _ in (self.views(at) if views is None else views))
            )
        return _joined(key, (one.value(key, at, percentile) for one in self.all_connections()))

    def values(self, keys: Iterable[str], at: int) -> Iterator[tuple[str, tuple[float | None, Window | None]]]:
        """Yield signals of the topic as ``value`` returns them; who tells what is found once for all."""
        publishers = [one for one, _ in self.views(at)]
        every = self.all_connections()
        seen = {one: window for one in every if (window := one.speaks(at)) is not None}
        plain = len(seen) == len(every) and seen.keys() >= {*publishers}
        for key in keys:
            if key in ENDS:
                yield key, (self._of_graph(key, every), None)
                continue
            if key == RECEIVED:
                yield key, self.value(key, at)
                continue
            reported = publishers if key in _OF_PUBLISHERS else every
            found = [(measured(seen[one], key), seen[one]) if plain else one.value(key, at) for one in reported]
            yield key, found[0] if len(found) == 1 else _joined(key, found)

    def remark(self, key: str, at: int) -> str:
        """Return who receives much less than what is sent, which is the rate of a topic."""
        if key != "rate":
            return ""
        received = self._received(at)
        sent = self.value(key, at)[0]
        least = min(sorted(received), key=lambda one: received[one][0], default="")
        if not least or not sent or received[least][0] >= _AS_SENT * sent:
            return ""
        return f"; sent at this rate, received at {received[least][0]:.3g} Hz by {least}"

    def _received(self, at: int, percentile: float = 0.0) -> dict[str, tuple[float, Window | None]]:
        """Return the rate at which each subscriber receives from all publishers, and a window that shows it."""
        received: dict[str, tuple[float, Window | None]] = {}
        for one in self.all_connections():
            value, window = one.value("rate", at, percentile) if one.subscriber else _UNKNOWN
            if value is not None:
                before, seen = received.get(one.subscriber, (0.0, window))
                received[one.subscriber] = before + value, seen
        return received

    def _of_graph(self, key: str, every: list[Connection] | None) -> float | None:
        if key == "misfits":
            return None if self.misfits is None else float(self.misfits)
        if self.known:
            of_publishers = key == "publishers"
            return float(len(self.publishers if of_publishers else self.subscribers) + self.more[not of_publishers])
        ends = {getattr(one, key[:-1]) for one in (self.all_connections() if every is None else every)} - {""}
        return float(len(ends)) if ends else None

    def silent_observer(self, key: str) -> ObserverStatus | None:
        """Return a silent observer without which a signal of the topic is unknown."""
        for publisher in sorted(self.connections):
            group = [one for one in self.connections[publisher] if not one.left]
            silent = [observer_status for one in group if (observer_status := one.silent_observer) is not None]
            # What is published is known where one end of it is observed, how it arrives where all are.
            if silent and (key not in _OF_PUBLISHERS or len(silent) == len(group)):
                return silent[0]
        return None

    def _of_last(self, connection: Connection) -> bool:
        """Whether a connection is of the last publishers: those that left before are no evidence of how it ended."""
        return connection.publisher in self.former


def _rate_of(received: tuple[float, Window | None]) -> float:
    return received[0]


def _ends(connection: Connection) -> tuple[str, str]:
    return connection.publisher, connection.subscriber


def _best(group: Sequence[Connection], at: int) -> list[tuple[Connection, Window]]:
    """Return where the traffic of a publisher is seen best, if it is seen at all."""
    seen = [(one, window) for one in group if (window := one.best(at))]
    return [min(seen, key=_quality)] if len(seen) > 1 else seen


def _quality(seen: tuple[Connection, Window]) -> tuple[bool, bool, bool, int, bool, float]:
    connection, window = seen
    quiet = window.horizon > window.until
    received = bool(connection.subscriber)
    # What its counters say that it sends is told where nobody receives all of it.
    counted = not received and window.observer is Observer.PROTOCOL
    return connection.left, quiet, not counted, RANK[window.observer], received, -window.count


def _joined(key: str, signals: Iterable[tuple[float | None, Window | None]]) -> tuple[float | None, Window | None]:
    seen = list(signals)
    if len(seen) == 1:
        return seen[0]
    reported = [(value, window) for value, window in seen if value is not None]
    if not reported:
        return None, seen[0][1] if seen else None
    return reported[0] if len(reported) == 1 else _folded(key, reported)


def _folded(key: str, reported: list[tuple[float, Window | None]]) -> tuple[float, Window | None]:
    values = [value for value, _ in reported]
    if key in SUMMED:
        return sum(values), reported[0][1]
    if key in _MEANS or key in ("period", "message_size"):
        weights = [window.count if window else 1 for _, window in reported]
        total = sum(weights)
        mean = sum(v * w for v, w in zip(values, weights, strict=True)) / total if total else sum(values) / len(values)
        return mean, reported[0][1]
    worst = max(range(len(values)), key=values.__getitem__)
    return values[worst], reported[worst][1]
