"""Traffic of connections, from counters that both of their ends keep; pure.

What the counters do not tell stays empty: there are no instants of messages, thus no periods, and no latencies.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec

from roslens.live.adapters.ros1.names import is_observer
from roslens.live.adapters.ros1.slave import BusStats, Counter, Link
from roslens.model.traffic.tally import Observer, Tally

AS_SENT = 0.9
"""A subscriber that gets a smaller share of what is sent to it says nothing of how much that is."""
_ENOUGH, _ENOUGH_S = 10, 2.0
"""Ends are read one after the other: only of so many messages in so many seconds is it known which share arrives."""
_LATELY, _LATELY_S = 50, 10.0
"""After so many more, what was counted before weighs half."""
_WRAP = 2**32
_HALF = 2**31


class Reading(msgspec.Struct, frozen=True):
    """What a node reported of its connections at an instant.

    Attributes:
        node: its name.
        uri: of its API; another one means another process, whose counters began anew.
        time: seconds on the observer's clock.
        stats: its counters.
        links: its connections.
    """

    node: str
    uri: str
    time: float
    stats: BusStats
    links: tuple[Link, ...]


class Stretch(msgspec.Struct, frozen=True):
    """The growth of one counter."""

    start: float
    end: float
    count: int
    bytes: int
    lost: int


_Key = tuple[str, str, str]
"""Topic, publisher, subscriber."""
_Counted = tuple[str, str, str, bool]
"""URI of the node, id of the connection, topic, whether it sends."""


def grown(before: int, after: int, wraps: bool) -> int | None:
    """Return by how much a counter grew; None where it began anew.

    >>> grown(2**31 - 10, -(2**31) + 10, wraps=True)
    20
    """
    if wraps:
        growth = (after - before) % _WRAP
        return growth if growth < _HALF else None
    return after - before if after >= before else None


def _key(node: str, counter: Counter, peer: str, homes: Mapping[str, str]) -> _Key:
    """Return the topic, the publisher and the subscriber of a connection that a node counts."""
    if counter.sends:
        return counter.topic, node, peer
    return counter.topic, homes.get(peer.rstrip("/"), ""), node


def _count(stretches: Iterable[Stretch]) -> int:
    return sum(one.count for one in stretches)


class Bus:
    """Turns readings into tallies.

    Both ends of a connection count it. What arrived is what the receiving end says; the sending end is heard where the
    other does not speak (roscpp tells of only one publisher of a topic, other libraries count no messages, a node may
    be silent). The first sight of a connection counts nothing: what it carried before has no known beginning. Where no
    subscriber gets nearly all that a publisher sends, what is sent is told as well, as traffic to nobody.

    Args:
        hidden: names of nodes that are not part of the system, besides those of observers.
        host: on which the observer stands.
    """

    def __init__(self, hidden: frozenset[str] = frozenset(), host: str = "") -> None:
        self._hidden = hidden
        self._host = host
        self._before: dict[str, dict[_Counted, tuple[float, Counter]]] = {}
        self._lately: dict[_Key, tuple[float, float, float]] = {}

    def tallies(self, readings: Iterable[Reading], homes: Mapping[str, str]) -> list[Tally]:
        """Return the traffic since the readings before, one tally a connection, sorted.

        Args:
            readings: at most one of each node.
            homes: names of nodes by the URI of their API, without a slash at the end.
        """
        received: dict[_Key, list[Stretch]] = {}
        sent: dict[_Key, list[Stretch]] = {}
        for reading in readings:
            for counter, peer, stretch in self._stretches(reading):
                key = _key(reading.node, counter, peer, homes)
                if not (self._hides(key[1]) or self._hides(key[2])):
                    (sent if counter.sends else received).setdefault(key, []).append(stretch)
        known = {key: received.get(key) or sent[key] for key in received.keys() | sent.keys()}
        known |= self._sent(sent, received)
        return [self._tally(key, known[key]) for key in sorted(known)]

    def _sent(
        self, sent: Mapping[_Key, list[Stretch]], received: Mapping[_Key, list[Stretch]]
    ) -> dict[_Key, list[Stretch]]:
        """Return what publishers send of whose messages every subscriber misses many."""
        for key in sent.keys() | received.keys():
            self._compare(key, sent.get(key, ()), received.get(key, ()))
        complete = {key[:2] for key in sent if not self._starves(key)}
        found: dict[_Key, list[Stretch]] = {}
        for key, stretches in sent.items():
            to_nobody = (*key[:2], "")
            if key[:2] not in complete and _count(found.get(to_nobody, ())) <= _count(stretches):
                found[to_nobody] = stretches
        return found

    def _compare(self, key: _Key, sent: Iterable[Stretch], received: Iterable[Stretch]) -> None:
        """Count what was sent over a connection lately, and what arrived, once both ends have told."""
        lately = self._lately.get(key)
        if lately is None and not (sent and received):
            return
        gone, come, seconds = lately or (0.0, 0.0, 0.0)
        gone, come = gone + _count(sent), come + _count(received)
        seconds += sum(one.end - one.start for one in sent)
        if gone > 2 * _LATELY and seconds > 2 * _LATELY_S:
            gone, come, seconds = gone / 2, come / 2, seconds / 2
        self._lately[key] = gone, come, seconds

    def _starves(self, key: _Key) -> bool:
        gone, come, seconds = self._lately.get(key, (0.0, 0.0, 0.0))
        return gone >= _ENOUGH and seconds >= _ENOUGH_S and come < AS_SENT * gone

    def _stretches(self, reading: Reading) -> Iterator[tuple[Counter, str, Stretch]]:
        """Yield what each connection of a node carried since its reading before, with its peer."""
        before = self._before.get(reading.node, {})
        self._before[reading.node] = {}
        peers = {(link.id, link.topic, link.sends): link.peer for link in reading.links}
        for counter in reading.stats.counters:
            peer = peers.get((counter.id, counter.topic, counter.sends))
            stretch = self._stretch(reading, counter, before) if peer is not None else None
            if peer is not None and stretch:
                yield counter, peer, stretch

    def _hides(self, node: str) -> bool:
        return node in self._hidden or is_observer(node)

    def forget(self, node: str) -> None:
        """Drop what was known of a node that is gone."""
        self._before.pop(node, None)
        self._lately = {key: lately for key, lately in self._lately.items() if node not in key[1:]}

    def _stretch(
        self, reading: Reading, counter: Counter, before: Mapping[_Counted, tuple[float, Counter]]
    ) -> Stretch | None:
        key = (reading.uri, counter.id, counter.topic, counter.sends)
        earlier = before.get(key)
        self._before[reading.node][key] = (reading.time, counter)
        if earlier is None or reading.time <= earlier[0]:
            return None
        count = grown(earlier[1].count, counter.count, reading.stats.wraps)
        size = grown(earlier[1].bytes, counter.bytes, reading.stats.wraps)
        if count is None or size is None:
            return None
        lost = -1
        if counter.drops >= 0 and earlier[1].drops >= 0:
            more = grown(earlier[1].drops, counter.drops, reading.stats.wraps)
            lost = -1 if more is None else more
        return Stretch(earlier[0], reading.time, count, max(size - counter.prefix * count, 0), lost)

    def _tally(self, key: _Key, stretches: list[Stretch]) -> Tally:
        known = [stretch.lost for stretch in stretches if stretch.lost >= 0]
        return Tally(
            *key,
            start=min(stretch.start for stretch in stretches),
            end=max(stretch.end for stretch in stretches),
            count=sum(stretch.count for stretch in stretches),
            bytes=sum(stretch.bytes for stretch in stretches),
            lost=sum(known) if known else -1,
            observer=Observer.PROTOCOL,
            host=self._host,
        )
