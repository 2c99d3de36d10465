"""The graph from the answers of the master and the nodes, and the changes between graphs; pure."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping

from roslens.live.adapters.ros1.master import SystemState
from roslens.model.acting.process_end import UNKNOWN
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Role

_VERBS = {
    Role.PUBLISHER: "published by",
    Role.SUBSCRIPTION: "subscribed by",
    Role.SERVICE_SERVER: "served by",
}


def build_graph(state: SystemState, types: Mapping[str, str], nodes: Mapping[str, Node]) -> Graph:
    """Return the graph of the nodes that live; what only dead ones are registered for is not in it.

    Args:
        state: registrations.
        types: of topics, by name.
        nodes: that live, by name.
    """
    endpoints = [
        Endpoint(node, role, name, types.get(name, "") if role is not Role.SERVICE_SERVER else "")
        for role, part in (
            (Role.PUBLISHER, state.publishers),
            (Role.SUBSCRIPTION, state.subscribers),
            (Role.SERVICE_SERVER, state.services),
        )
        for name, node in part
        if node in nodes
    ]
    hosts = sorted({node.host for node in nodes.values() if node.host})
    endpoints.sort(key=lambda end: (end.node, end.role.value, end.name))
    return Graph("ros1", tuple(nodes[name] for name in sorted(nodes)), tuple(endpoints), tuple(hosts))


def _text(kind: EntityKind, name: str) -> str:
    return str(EntityId(kind, name))


def _kind(role: Role) -> EntityKind:
    return EntityKind.SERVICE if role is Role.SERVICE_SERVER else EntityKind.TOPIC


def changes(
    before: Graph, after: Graph, time: float, reasons: Mapping[str, str], dead: Collection[str] = ()
) -> list[Event]:
    """Return what happened between two graphs, nodes first, sorted.

    Args:
        before: the graph until now.
        after: the graph from now on.
        time: seconds on the observer's clock.
        reasons: why nodes vanished, or what else is to be said of them, by name.
        dead: nodes that nobody answers for any more, though they did not unregister.
    """
    return [*_node_changes(before, after, time, reasons, dead), *_name_changes(before, after, time)]


def _node_changes(
    before: Graph, after: Graph, time: float, reasons: Mapping[str, str], dead: Collection[str]
) -> list[Event]:
    old = {node.name: node for node in before.nodes}
    new = {node.name: node for node in after.nodes}
    events = []
    for name in sorted(old.keys() | new.keys()):
        entity, reason = _text(EntityKind.NODE, name), reasons.get(name, "")
        if name not in new:
            # Who is asked to end unregisters: one that is dead beforehand was not.
            ended = UNKNOWN if name in dead else ""
            events.append(Event(time, Change.VANISHED, entity, reason or "unregistered at the master", ended))
        elif name not in old:
            events.append(Event(time, Change.APPEARED, entity, reason))
        elif old[name].pid and new[name].pid and (old[name].host, old[name].pid) != (new[name].host, new[name].pid):
            detail = f"process {old[name].pid} on {old[name].host} is now {new[name].pid} on {new[name].host}"
            events.append(Event(time, Change.RESTARTED, entity, detail))
        elif old[name] != new[name]:
            events.append(Event(time, Change.CHANGED, entity, reason or "its host or process became known"))
    return events


def _name_changes(before: Graph, after: Graph, time: float) -> list[Event]:
    old, new = _by_name(before.endpoints), _by_name(after.endpoints)
    events = []
    for kind, name in sorted(old.keys() | new.keys()):
        ends, entity = new.get((kind, name)), _text(kind, name)
        if ends is None:
            events.append(Event(time, Change.VANISHED, entity))
        elif (kind, name) not in old:
            events.append(Event(time, Change.APPEARED, entity, ", ".join(_said(ends.keys()))))
        elif ends != (earlier := old[kind, name]):
            gone = [f"no longer {text}" for text in _said(earlier.keys() - ends.keys())]
            types = sorted(set(ends.values()) - set(earlier.values()))
            retyped = [f"its type is now {', '.join(types)}"] if types and ends.keys() & earlier.keys() else []
            detail = ", ".join([*_said(ends.keys() - earlier.keys()), *gone, *retyped])
            events.append(Event(time, Change.CHANGED, entity, detail))
    return events


def _by_name(ends: Iterable[Endpoint]) -> dict[tuple[EntityKind, str], dict[tuple[str, str], str]]:
    names: dict[tuple[EntityKind, str], dict[tuple[str, str], str]] = {}
    for end in ends:
        names.setdefault((_kind(end.role), end.name), {})[_VERBS[end.role], end.node] = end.type
    return names


def _said(ends: Iterable[tuple[str, str]]) -> list[str]:
    return [f"{verb} {node}" for verb, node in sorted(ends)]
