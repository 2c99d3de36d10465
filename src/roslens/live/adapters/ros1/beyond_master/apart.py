"""Publishers and subscriptions of a topic that are not connected, though both run: mostly their types differ.

The master keeps one type for each topic, and tells nobody of another. But a publisher refuses a subscriber whose type
or definition differs from its own, and lists those that it accepted. A rospy subscriber lists also those that it tries
to reach, so that only the list of the publisher counts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import msgspec

from roslens.live.adapters.ros1.bus import Reading
from roslens.live.adapters.ros1.contact import RENEW_LINKS
from roslens.live.adapters.ros1.master import SystemState
from roslens.model.graph import Endpoint, Graph, Role

PATIENCE = RENEW_LINKS + 2
"""Rounds without a connection after which there is none: so long a publisher may not have been asked for its list."""
MOST_PUBLISHERS = 10
"""A topic with more is not one that two nodes took for different things; they are not asked for their types."""
_OF_ALL = frozenset(("/rosout", "/statistics", "/diagnostics", "/tf", "/tf_static"))

TypeOf = Callable[[str, str], str]
"""The type that a node publishes on a topic, as it says itself; empty while unknown."""


class Apart:
    """Counts for how many rounds each publisher of a topic has had no connection to each of its subscribers."""

    def __init__(self) -> None:
        """Begin without any."""
        self._rounds: dict[tuple[str, str, str], int] = {}

    def take(self, state: SystemState, readings: Iterable[Reading]) -> None:
        """Take what nodes reported in a round; of those that did not nothing new is known."""
        links = {one.node: {(link.topic, link.peer) for link in one.links if link.sends} for one in readings}
        rounds: dict[tuple[str, str, str], int] = {}
        for topic, publisher, subscriber in _pairs(state):
            key = (topic, publisher, subscriber)
            if publisher not in links or subscriber not in links:
                if key in self._rounds:
                    rounds[key] = self._rounds[key]
            elif (topic, subscriber) in links[publisher]:
                rounds[key] = 0
            else:
                rounds[key] = self._rounds.get(key, 0) + 1
        self._rounds = rounds

    def wanted(self, state: SystemState) -> list[tuple[str, str]]:
        """Return topics and publishers whose own types matter, since others of the topic may differ."""
        by_topic: dict[str, list[str]] = {}
        for topic, node in state.publishers:
            by_topic.setdefault(topic, []).append(node)
        apart = {topic for (topic, _, _), rounds in self._rounds.items() if rounds >= PATIENCE}
        return [
            (topic, node)
            for topic, nodes in by_topic.items()
            if topic in apart or (1 < len(nodes) <= MOST_PUBLISHERS and topic not in _OF_ALL)
            for node in nodes
        ]

    def completed(self, graph: Graph, type_of: TypeOf) -> Graph:
        """Return a graph with the types that publishers say they have, and what is apart."""
        known: dict[tuple[str, str], dict[str, int]] = {}
        for (topic, publisher, subscriber), rounds in self._rounds.items():
            known.setdefault((topic, subscriber), {})[publisher] = rounds
        ends = tuple(_completed(end, type_of, known.get((end.name, end.node))) for end in graph.endpoints)
        return msgspec.structs.replace(graph, endpoints=ends)


def _completed(end: Endpoint, type_of: TypeOf, rounds: Mapping[str, int] | None) -> Endpoint:
    if end.role is Role.PUBLISHER:
        own = type_of(end.name, end.node)
        return msgspec.structs.replace(end, type=own) if own else end
    if end.role is not Role.SUBSCRIPTION or rounds is None or any(0 < one < PATIENCE for one in rounds.values()):
        return end
    apart = tuple(sorted(publisher for publisher, one in rounds.items() if one))
    # The type that the master keeps may be that of the other side.
    return msgspec.structs.replace(end, apart=apart, type="" if apart else end.type)


def _pairs(state: SystemState) -> Iterable[tuple[str, str, str]]:
    publishers: dict[str, list[str]] = {}
    for topic, node in state.publishers:
        publishers.setdefault(topic, []).append(node)
    for topic, subscriber in state.subscribers:
        for publisher in publishers.get(topic, ()):
            if publisher != subscriber and topic not in _OF_ALL:
                yield topic, publisher, subscriber
