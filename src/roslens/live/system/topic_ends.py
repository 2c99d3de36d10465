"""Who is on each topic, by a graph."""

from __future__ import annotations

from itertools import chain

import msgspec

from roslens.live.system.connection import Connection
from roslens.live.system.copies import Copies
from roslens.live.system.topic import Topic
from roslens.model.graph import Endpoint, Graph, Role

_OF_TOPICS = (Role.PUBLISHER, Role.SUBSCRIPTION)


class Ends(msgspec.Struct):
    """Who is on a topic, with which types; ``more`` are the nodes beyond the names: publishers, subscribers."""

    publishers: set[str]
    subscribers: set[str]
    types: set[str]
    more: tuple[int, int] = (0, 0)


NOBODY = Ends(set(), set(), set())


def ends_of(graph: Graph) -> tuple[dict[str, Ends], dict[str, set[str]], dict[str, set[str]]]:
    """Return who is on each topic, and the topics that each node publishes and subscribes to."""
    published: dict[str, set[str]] = {}
    subscribed: dict[str, set[str]] = {}
    found: dict[str, Ends] = {}
    copies = Copies(graph)
    of_copies: dict[str, tuple[list[Endpoint], list[Endpoint]]] = {}
    for end in graph.endpoints:
        if not end.name or end.role not in _OF_TOPICS:
            continue
        ends = found.get(end.name)
        if ends is None:
            ends = found[end.name] = Ends(set(), set(), set())
        if end.role is Role.PUBLISHER:
            ends.publishers.add(end.node)
            published.setdefault(end.node, set()).add(end.name)
        else:
            ends.subscribers.add(end.node)
            subscribed.setdefault(end.node, set()).add(end.name)
        if end.type:
            ends.types.add(end.type)
        if copies:
            of_copies.setdefault(end.name, ([], []))[end.role is not Role.PUBLISHER].append(end)
    for name, (publishing, subscribing) in of_copies.items():
        found[name].more = (copies.surplus(publishing), copies.surplus(subscribing))
    return found, published, subscribed


def take_ends(topic: Topic, ends: Ends) -> bool:
    """Note who is on a topic; return whether that is something else than before."""
    publishers, subscribers, types = frozenset(ends.publishers), frozenset(ends.subscribers), frozenset(ends.types)
    known = bool(publishers or subscribers)
    before = (topic.publishers, topic.subscribers, topic.types, topic.known, topic.more)
    if before == (publishers, subscribers, types, known, ends.more):
        return False
    topic.former = topic.publishers or topic.former
    topic.publishers, topic.subscribers, topic.more = publishers, subscribers, ends.more
    topic.types = types or topic.types
    topic.known = known
    topic.seen |= known
    for one in chain.from_iterable(topic.connections.values()):
        one.gone = lacks_end(topic, one)
    return True


def lacks_end(topic: Topic, connection: Connection) -> bool:
    """Whether a graph that has the topic lacks an end of a connection."""
    lost = connection.publisher and connection.publisher not in topic.publishers
    return bool(lost or (connection.subscriber and connection.subscriber not in topic.subscribers))
