"""The envelope of a connection: what its tallies have to be so that no verdict about it or its topic changes."""

from __future__ import annotations

from roslens.live.standing.measured import Group
from roslens.live.system.connection import Connection
from roslens.live.system.envelope import Envelope
from roslens.live.system.topic import Topic
from roslens.live.window.signals import ENDS, RECEIVED, SUMMED


def envelope_of(connection: Connection, topic: Topic) -> Envelope | None:
    """Return what a tally of a connection has to be so that no verdict about it or its topic changes.

    None where a verdict is not fine, or where what its windows hold now is not all inside, for what leaves them
    changes their values too.
    """
    alone = connection.alone
    if alone is None or connection.gone or (topic.judged and not topic.calm):
        return None
    of_topic = _shares(connection, topic)
    if of_topic is None:
        return None
    envelope = Envelope(alone)
    for group, share in (*((group, 1.0) for group in connection.groups), *of_topic):
        if not group.calm or not envelope.narrow(group, alone[group.at], share):
            return None
    if all(envelope.lets_be(bucket) for window in alone for bucket in window.buckets):
        return envelope
    return None


def _shares(connection: Connection, topic: Topic) -> list[tuple[Group, float]] | None:
    """Return of which share of each group of a topic a connection may dispose; None where one cannot be determined."""
    groups: list[tuple[Group, float]] = []
    shares: dict[str, float | None] = {}
    for group in topic.groups:
        if group.key in ENDS or (group.key == RECEIVED and not connection.subscriber):
            continue
        if (
            group.key == RECEIVED
            and sum(not all(map(topic.tells_nothing, of)) for of in topic.connections.values()) > 1
        ):
            # How much of what a subscriber receives is from which publisher is not looked for.
            return None
        if group.key in SUMMED and group.key not in shares:
            shares[group.key] = _share(connection, topic, group)
        share = shares.get(group.key, 1.0)
        if share is None:
            return None
        groups.append((group, share))
    return groups


def _share(connection: Connection, topic: Topic, group: Group) -> float | None:
    """Return which part of a sum over publishers is from that of a connection."""
    if len(topic.connections) == 1:
        return 1.0
    for one, _ in topic.views(group.at):
        if one.publisher == connection.publisher:
            value, _ = one.value(group.key, group.at)
            return value / group.value if value and group.value else None
    return None
