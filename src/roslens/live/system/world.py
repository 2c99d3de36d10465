"""Everything a monitor knows of: connections, topics, hosts, nodes and processes, and how they hang together."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from roslens.judge.reference.expectation import End
from roslens.live.standing.measured import Measured
from roslens.live.standing.presence import Key
from roslens.live.standing.rulebook import Facts
from roslens.live.system.connection import Connection
from roslens.live.system.connection_name import connection_ends
from roslens.live.system.copies import proven_copies
from roslens.live.system.halted import Halted
from roslens.live.system.misfit import misfits_by_topic
from roslens.live.system.sampled import Sampled
from roslens.live.system.topic import Topic
from roslens.live.system.topic_ends import NOBODY, ends_of, lacks_end, take_ends
from roslens.live.window.newest import MOST_GONE
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.traffic.tally import Tally

MAX_ENTITIES = 100_000
"""Connections, topics and sampled entities together; more are refused and counted."""
FORGET_GONE_S = 300.0
"""After which a connection is forgotten that the graph has no more, and a process or node that is not sampled."""
FORGET_QUIET_S = 3600.0
"""After which a silent connection is forgotten that no graph reports as gone."""
SURPLUS_S = 60.0
"""After which a silent connection that nobody judges, and that is gone or was in no graph, may give its place to newer
ones."""
MOST_SURPLUS = 100
"""Such connections that are kept for longer. Each has windows and lines of its own, some 10 kB: those of tools that
come and go every second would be the most of what a monitor keeps."""

_COMING_AND_GOING = (EntityKind.NODE, EntityKind.SERVICE)

_ENDS = {
    Role.SERVICE_SERVER: EntityKind.SERVICE,
    Role.ACTION_SERVER: EntityKind.ACTION,
}


class World:
    """The entities of a system.

    Attributes:
        connections: by topic, publisher and subscriber.
        topics: by name.
        sampled: hosts, nodes and processes by id.
        graph: the newest one; None before the first.
        refused: records of entities that were one too many.
    """

    def __init__(self) -> None:
        self.connections: dict[tuple[str, str, str], Connection] = {}
        self.topics: dict[str, Topic] = {}
        self.sampled: dict[EntityId, Sampled] = {}
        self.graph: Graph | None = None
        self.refused = 0
        self.published: dict[str, set[str]] = {}
        self.subscribed: dict[str, set[str]] = {}
        self._servers: dict[EntityId, set[str]] = {}
        self._hosts: dict[str, str] = {}

    @property
    def full(self) -> bool:
        """Whether there is no room for one more entity."""
        return len(self.connections) + len(self.topics) + len(self.sampled) >= MAX_ENTITIES

    def host_of(self, node: str) -> str:
        """Return the host of a node, empty where unknown."""
        return self._hosts.get(node, "")

    def topic(self, name: str, now: float) -> Topic:
        """Return a topic, a new one if need be."""
        topic = self.topics.get(name)
        if topic is None:
            topic = self.topics[name] = Topic(name, now)
        return topic

    def connection(self, tally: Tally, now: float) -> Connection | None:
        """Return the connection that a tally is about, a new one if need be; None where there is no room."""
        key = (tally.topic, tally.publisher, tally.subscriber)
        found = self.connections.get(key)
        if found is None:
            if self.full:
                self.refused += 1
                return None
            found = self.connections[key] = Connection(*key, now)
            topic = self.topic(tally.topic, now)
            found.gone = topic.known and lacks_end(topic, found)
        return found

    def entity(self, entity: EntityId, now: float) -> Sampled | None:
        """Return what is sampled of an entity, a new one if need be; None where there is no room."""
        found = self.sampled.get(entity)
        if found is None:
            if self.full:
                self.refused += 1
                return None
            found = self.sampled[entity] = Sampled(entity, now)
            if entity.kind is EntityKind.HOST:
                found.host = entity.name
            elif entity.kind is EntityKind.PROCESS:
                found.host = entity.name.rpartition("/")[0]
            else:
                found.host = self.host_of(entity.name)
        return found

    def entity_named(self, kind: EntityKind, name: str, now: float) -> Sampled | None:
        """Return what is sampled of an entity of this kind and name."""
        return self.entity(EntityId(kind, name), now)

    def connection_of(self, entity: EntityId) -> Connection | None:
        """Return a connection by its id, None where it is not known."""
        return self.connections.get(connection_ends(entity))

    def sampled_by(self, key: Key) -> Sampled | None:
        """Return what is sampled of an entity, None where nothing is."""
        return self.sampled.get(EntityId(*key))

    def entities(self) -> Iterator[Measured]:
        """Yield everything with signals."""
        return chain(self.topics.values(), self.connections.values(), self.sampled.values())

    def concerned(self, entity: EntityId) -> Iterator[Measured]:
        """Yield an entity and, of a node, the topics it publishes and their connections."""
        sampled = self.sampled.get(entity)
        if sampled is not None:
            yield sampled
        names = self.published.get(entity.name, ()) if entity.kind is EntityKind.NODE else (entity.name,)
        if entity.kind not in (EntityKind.NODE, EntityKind.TOPIC):
            return
        for name in sorted(names):
            topic = self.topics.get(name)
            if topic is not None:
                yield topic
                yield from chain.from_iterable(topic.connections.values())

    def outdated(self, now: float) -> list[Connection]:
        """Return the connections that are gone, or silent without a graph that knows them, for long.

        Of the silent ones that nobody judges only the newest are kept for so long: a tool that comes for a moment
        leaves several, and one that ends at once is in no graph that could say that it has gone.
        """
        silent = [
            (now - since, one) for one in self.connections.values() if (since := self._silent_since(one)) is not None
        ]
        unjudged = sorted(
            ((long, one) for long, one in silent if long > SURPLUS_S and not self._matters(one)),
            key=lambda found: found[0],
        )
        surplus = {id(one) for _, one in unjudged[MOST_SURPLUS:]}
        return [
            one for long, one in silent if long > (FORGET_GONE_S if one.gone else FORGET_QUIET_S) or id(one) in surplus
        ]

    def _matters(self, connection: Connection) -> bool:
        """Whether it, or the topic it is of, is judged."""
        topic = self.topics.get(connection.topic)
        return bool(connection.judged or (topic is not None and topic.judged))

    def _silent_since(self, connection: Connection) -> float | None:
        """Return when something was last noticed of a connection; None of one that is only expected as yet."""
        quiet = connection.quiet_since
        return connection.appeared if quiet is None and not self._matters(connection) else quiet

    def outdated_samples(self, now: float) -> list[Sampled]:
        """Return the processes of which nothing is sampled for long, and the nodes and services that nothing judges."""
        return [
            one
            for one in self.sampled.values()
            if (one.id.kind is EntityKind.PROCESS or (one.id.kind in _COMING_AND_GOING and not one.judged))
            and one.seen
            and not one.known
            and now - one.noticed > FORGET_GONE_S
        ]

    def outdated_topics(self) -> list[Topic]:
        """Return the topics that are gone, that nobody expects by their name, and after which many others went.

        Those with connections that are remembered count among the many.
        """
        gone = [one for one in self.topics.values() if _gone(one) and not _expected(one)]
        return [one for one in gone[: max(len(gone) - MOST_GONE, 0)] if not one.connections]

    def ended(self) -> set[EntityId]:
        """Return the topics, and connections of these, that graphs had and have no more and that nothing judges."""
        topics = [one for one in self.topics.values() if _ended(one)]
        return {one.id for topic in topics for one in (topic, *topic.all_connections()) if not one.judged}

    def forget(self, connection: Connection) -> None:
        """Let a connection go, and its topic when that was all that is known of it."""
        del self.connections[(connection.topic, connection.publisher, connection.subscriber)]
        self.topics[connection.topic].remove(connection)

    def take_graph(self, graph: Graph, now: float) -> Iterator[Connection | Topic | Sampled]:
        """Replace the graph; yield every entity of which something else is known than before."""
        ends, self.published, self.subscribed = ends_of(graph)
        self.graph = graph
        self._take_servers(graph)
        moved = self._take_hosts(graph)
        misfits = misfits_by_topic(graph.endpoints, by_connection=graph.generation == "ros1")
        for name in sorted(ends.keys() - self.topics.keys()):
            if self.full:
                self.refused += 1
                break
            self.topic(name, now)
        for topic in self.topics.values():
            of_topic = ends.get(topic.name, NOBODY)
            before, topic.misfits = topic.misfits, misfits.get(topic.name)
            if take_ends(topic, of_topic) or moved & of_topic.publishers or before != topic.misfits:
                yield topic
                yield from chain.from_iterable(topic.connections.values())
        for sampled in self.sampled.values():
            if sampled.id.kind is EntityKind.NODE and sampled.id.name in moved:
                sampled.host = self.host_of(sampled.id.name)
                yield sampled

    def _take_servers(self, graph: Graph) -> None:
        """Note the servers; a service that has no server any more depends on its last ones."""
        servers: dict[EntityId, set[str]] = {}
        for end in graph.endpoints:
            if (kind := _ENDS.get(end.role)) is not None:
                servers.setdefault(EntityId(kind, end.name), set()).add(end.node)
        former = [one for one in self._servers.items() if one[0] not in servers]
        self._servers = {**dict(former[-MOST_GONE:]), **servers}

    def _take_hosts(self, graph: Graph) -> set[str]:
        """Note where nodes are; return those that are somewhere else than before."""
        moved = set()
        for node in graph.nodes:
            if node.host and self._hosts.get(node.name) != node.host:
                self._hosts[node.name] = node.host
                moved.add(node.name)
        if len(self._hosts) > len(graph.nodes) + MOST_GONE:
            self._hosts = {node.name: node.host for node in graph.nodes if node.host}
        return moved

    def facts(self, entity: Connection | Topic | Sampled) -> Facts:
        """Return what selectors may ask of an entity besides its name."""
        if isinstance(entity, Topic):
            publishers = entity.publishers or frozenset(filter(None, entity.connections))
            hosts = {self.host_of(node) for node in publishers} - {""}
            copies = tuple(sorted(publishers)) if len(publishers) > 1 else ()
            return Facts(
                frozenset(hosts or _observers(entity)), entity.types, publishers, copies=copies, by=_ends_there(entity)
            )
        if isinstance(entity, Connection):
            host = self.host_of(entity.publisher) or entity.host
            topic = self.topics.get(entity.topic)
            types = topic.types if topic else frozenset[str]()
            return Facts(_one(host), types, _one(entity.publisher), entity.subscriber, entity.topic)
        return Facts(_one(entity.host))

    def existing(self, graph: Graph) -> dict[Key, Facts]:
        """Return what exists by a graph."""
        found: dict[Key, Facts] = {}
        for node in graph.nodes:
            found[EntityKind.NODE, node.name] = Facts(_one(node.host), copies=proven_copies(node))
            if node.host:
                found[EntityKind.HOST, node.host] = Facts(_one(node.host))
            for parameter in graph.parameters.get(node.name, ()):
                found[EntityKind.PARAMETER, f"{node.name}/{parameter}"] = Facts(_one(node.host))
        for host in graph.hosts:
            found[EntityKind.HOST, host] = Facts(_one(host))
        for process in graph.processes:
            found[EntityKind.PROCESS, f"{process.host}/{process.pid}"] = Facts(_one(process.host))
        found.update(self._served(graph))
        for topic in self.topics.values():
            if topic.known:
                found[EntityKind.TOPIC, topic.name] = self.facts(topic)
        return found

    def _served(self, graph: Graph) -> Iterator[tuple[Key, Facts]]:
        """Yield the services and actions that have a server: a client alone is none."""
        servers: dict[Key, list[Endpoint]] = {}
        for end in graph.endpoints:
            if (kind := _ENDS.get(end.role)) is not None:
                servers.setdefault((kind, end.name), []).append(end)
        for key, ends in servers.items():
            last, nodes = ends[-1], tuple(sorted({end.node for end in ends}))
            copies = nodes if len(nodes) > 1 else ()
            yield key, Facts(_one(self.host_of(last.node)), _one(last.type), _one(last.node), copies=copies)

    def stopped(self, now: float) -> Iterator[tuple[EntityId, float]]:
        """Yield the nodes whose process is stopped, as it was sampled lately, and since when."""
        for sampled in self.sampled.values():
            if sampled.id.kind is EntityKind.NODE and sampled.silent_observer is None and sampled.fresh(now):
                seconds = sampled.newest("stopped")
                if seconds:
                    yield sampled.id, sampled.noticed - seconds

    def halted(self, now: float) -> Iterator[Halted]:
        """Yield the nodes whose process is stopped or hangs, as it was sampled lately."""
        for sampled in self.sampled.values():
            if sampled.id.kind is EntityKind.NODE and sampled.silent_observer is None and sampled.fresh(now):
                for key in ("stopped", "hung"):
                    if seconds := sampled.newest(key):
                        yield Halted(sampled.id, key == "hung", sampled.noticed - seconds)

    def waits_for_processor(self, who: EntityId, now: float) -> float:
        """Return for which share of the time, in percent, a node or process waits for a processor; 0 where unknown."""
        sampled = self.sampled_by((who.kind, who.name))
        if sampled is None or not sampled.fresh(now):
            return 0.0
        return sampled.newest("cpu_wait") or 0.0

    def upstream(self, entity: EntityId) -> list[EntityId]:
        """Return what an entity depends on."""
        if entity.kind is EntityKind.TOPIC:
            topic = self.topics.get(entity.name)
            nodes = {*(topic.publishers or topic.former), *filter(None, topic.connections)} if topic else set()
            return [EntityId(EntityKind.NODE, node) for node in nodes]
        if entity.kind is EntityKind.CONNECTION:
            topic_name, publisher, subscriber = connection_ends(entity)
            found = [EntityId(EntityKind.TOPIC, topic_name)]
            return found + [EntityId(EntityKind.NODE, node) for node in (publisher, subscriber) if node]
        if entity.kind is EntityKind.NODE:
            host = self.host_of(entity.name)
            inputs = [EntityId(EntityKind.TOPIC, name) for name in self.subscribed.get(entity.name, ())]
            return inputs + ([EntityId(EntityKind.HOST, host)] if host else [])
        if entity.kind in (EntityKind.SERVICE, EntityKind.ACTION):
            return [EntityId(EntityKind.NODE, node) for node in self._servers.get(entity, ())]
        if entity.kind is EntityKind.PROCESS:
            return [EntityId(EntityKind.HOST, entity.name.rpartition("/")[0])]
        return []


def _one(text: str) -> frozenset[str]:
    return frozenset((text,)) if text else frozenset()


def _observers(topic: Topic) -> set[str]:
    return {one.host for group in topic.connections.values() for one in group} - {""}


def _ends_there(topic: Topic) -> frozenset[End] | None:
    """Return the ends that a graph has of a topic; None of one that is known by its traffic alone."""
    if not topic.known:
        return None
    ends = ((End.PUBLISHER, topic.publishers), (End.SUBSCRIBER, topic.subscribers))
    return frozenset(end for end, nodes in ends if nodes)


def _gone(topic: Topic) -> bool:
    """Whether graphs had a topic and have it no more."""
    return bool(topic.seen) and not (topic.known or topic.planless)


def _ended(topic: Topic) -> bool:
    """Whether graphs had a topic and no longer have it, and nothing judges it."""
    return _gone(topic) and not topic.judged


def _expected(topic: Topic) -> bool:
    """Whether a constraint names a topic, and not only a pattern that others match too."""
    return any(one.constraint.literal is not None for one in topic.judged)
