"""The API of a node: its process, its connections and what they carried."""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.live.adapters.ros1.names import MOST_ENTRIES, Oddities, sound_name
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.xml_rpc import Caller, CallError, Trouble, read_answer, unwrap
from roslens.model.failure import Failure

FRAMING = 4
"""Bytes of the length before each message."""


class Link(msgspec.Struct, frozen=True, order=True):
    """A connection as one of its ends names it.

    ``peer`` is the name of the subscriber where ``sends``, else the URI of the publisher's API.
    """

    id: str
    topic: str
    sends: bool
    peer: str


class Counter(msgspec.Struct, frozen=True, order=True):
    """What a connection carried since it exists, as one of its ends counts.

    ``bytes`` hold ``prefix`` bytes of framing for each message; ``drops`` is -1 where the end does not count them.
    """

    id: str
    topic: str
    sends: bool
    count: int
    bytes: int
    prefix: int = FRAMING
    drops: int = -1


class BusStats(msgspec.Struct, frozen=True):
    """Counters of a node; ``wraps`` where they are of 32 bits and begin again (roscpp)."""

    counters: tuple[Counter, ...] = ()
    wraps: bool = False
    oddities: tuple[Failure, ...] = ()


def _whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _link_id(value: Any) -> str:
    return str(value)[:64] if isinstance(value, (int, str)) else ""


def read_links(value: Any, source: str) -> tuple[tuple[Link, ...], tuple[Failure, ...]]:
    """Read what getBusInfo returns: ``[[id, peer, direction, transport, topic, connected, text], …]``."""
    oddities = Oddities(source)
    if not isinstance(value, list):
        oddities.add("connections that are", value, "a list")
        value = []
    links: set[Link] = set()
    for row in value[:MOST_ENTRIES]:
        link = _read_link(row)
        if link:
            links.add(link)
        else:
            oddities.add("the connection", row, "[id, peer, direction, transport, topic, connected]")
    return tuple(sorted(links)), oddities.failures()


def _read_link(row: Any) -> Link | None:
    if not isinstance(row, list) or len(row) < 5 or row[2] not in ("i", "o", "b"):
        return None
    if not sound_name(row[1]) or not sound_name(row[4]) or not _link_id(row[0]):
        return None
    return Link(_link_id(row[0]), row[4], row[2] == "o", row[1])


def read_stats(answer: Any, source: str) -> BusStats:
    """Read the whole answer of getBusStats.

    rospy answers ``[1, "", [publications, subscriptions, services]]`` with publications of the form
    ``[topic, bytes, [[id, bytes, messages, connected], …]]`` and subscriptions of the form
    ``[topic, [[id, bytes, messages, -1, connected], …]]``; its bytes hold the length before each message.
    roscpp forgets code and message and answers ``[publications, subscriptions]`` with
    ``[topic, [[id, bytes, payload, messages, 0], …]]`` and ``[topic, [[id, bytes, messages, drops, 0], …]]``; it
    counts lengths only where it sends, and of the publishers of a topic it tells only the last.

    Raises:
        CallError: it is neither.
    """
    roscpp = isinstance(answer, list) and len(answer) in (2, 3) and isinstance(answer[0], list)
    parts = answer if roscpp else unwrap(answer, "getBusStats")
    if not isinstance(parts, list) or len(parts) < 2:
        raise CallError(Trouble.GARBLED, f"the statistics are {repr(parts)[:80]}, expected two or three lists")
    oddities = Oddities(source)
    counters = [*_read_side(parts[0], True, roscpp, oddities), *_read_side(parts[1], False, roscpp, oddities)]
    return BusStats(tuple(sorted(set(counters))), roscpp, oddities.failures())


def _read_side(value: Any, sends: bool, roscpp: bool, oddities: Oddities) -> list[Counter]:
    if not isinstance(value, list):
        oddities.add("statistics that are", value, "a list")
        return []
    counters: list[Counter] = []
    for entry in value[:MOST_ENTRIES]:
        if not (isinstance(entry, list) and len(entry) in (2, 3) and isinstance(entry[-1], list)):
            oddities.add("the statistics", entry, "[topic, (bytes,) rows]")
            continue
        if not sound_name(entry[0]):
            oddities.add("the name", entry[0], "a printable name of at most 1,024 characters")
            continue
        for row in entry[-1][: MOST_ENTRIES - len(counters)]:
            counter = _read_row(entry[0], row, sends, roscpp)
            if counter:
                counters.append(counter)
            else:
                oddities.add("the counters", row, "[id, bytes, messages, ...]")
    return counters


def _read_row(topic: str, row: Any, sends: bool, roscpp: bool) -> Counter | None:
    if not isinstance(row, list) or not _link_id(row[0] if row else None):
        return None
    place = 3 if sends and len(row) == 5 else 2
    if len(row) < (4 if sends else 5) or not _whole(row[1]) or not _whole(row[place]):
        return None
    drops = row[3] if roscpp and not sends and _whole(row[3]) else -1
    prefix = 0 if roscpp and not sends else FRAMING
    return Counter(_link_id(row[0]), topic, sends, row[place], row[1], prefix, drops)


class Slave:
    """The API of one node, asked as node ``caller``; not for two threads at once."""

    def __init__(self, uri: str, caller: str, resolver: Resolver, wait_s: float = 1.0) -> None:
        self.uri = uri
        self._body = b""
        self._stats = BusStats()
        self._caller = caller
        self._line = Caller(uri, resolver, wait_s)

    def pid(self) -> int:
        """Return the number of the node's process, as it is in the node's own PID namespace.

        Raises:
            CallError: the node does not tell.
        """
        pid = unwrap(self._line.call("getPid", self._caller), "getPid")
        if not _whole(pid) or not 0 < pid < 2**31:
            raise CallError(Trouble.GARBLED, f"the process is {repr(pid)[:80]}, expected a positive number")
        return int(pid)

    def links(self) -> tuple[tuple[Link, ...], tuple[Failure, ...]]:
        """Return the connections, and what had to be left out.

        Raises:
            CallError: the node does not tell.
        """
        return read_links(unwrap(self._line.call("getBusInfo", self._caller), "getBusInfo"), self.uri)

    def stats(self) -> BusStats:
        """Return what the connections carried.

        Raises:
            CallError: the node does not tell.
        """
        body = self._line.ask("getBusStats", self._caller)
        if body != self._body:  # that of an idle node need not be read again
            self._stats = read_stats(read_answer(body, "getBusStats"), self.uri)
            self._body = body
        return self._stats

    def request(self, topic: str) -> tuple[str, int]:
        """Return host and port at which a topic is to be had over TCPROS.

        Raises:
            CallError: the node does not offer it.
        """
        place = unwrap(self._line.call("requestTopic", self._caller, topic, [["TCPROS"]]), "requestTopic")
        sound = isinstance(place, list) and len(place) >= 3 and isinstance(place[1], str) and _whole(place[2])
        if sound and 0 < place[2] < 2**16:
            return place[1], place[2]
        raise CallError(Trouble.GARBLED, f"requestTopic answers {repr(place)[:80]}, expected [TCPROS, host, port]")

    @property
    def descriptor(self) -> int:
        """The open connection, whose end is the end of the process there; -1 without one."""
        return self._line.descriptor

    def close(self) -> None:
        """Hang up."""
        self._line.close()
