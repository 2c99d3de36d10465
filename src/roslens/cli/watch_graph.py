"""The graph as the live page draws it: who publishes what to whom, with the state and rate of each line."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache

import msgspec

from roslens.dashboard.live.places import Places
from roslens.dashboard.live.snapshot import UNJUDGED, Item, Link, Picture, Row
from roslens.live.connection_name import connection_ends
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.verdict import State, Verdict

PLUMBING = frozenset({"/rosout", "/rosout_agg", "/parameter_events"})
"""Topics that join every node to every other and say nothing of the system."""
MOST_APART = 120
"""Topics up to which each is drawn on its own; of more, those that join the same nodes are drawn as one."""
MOST_DRAWN = 1500
_WORSE = {state: place for place, state in enumerate((UNJUDGED, *(state.value for state in State)))}
_PUBLISHES, _SUBSCRIBES = Role.PUBLISHER, Role.SUBSCRIPTION


def encodable(text: str) -> str:
    """Return a text that can be written as UTF-8: what cannot is replaced."""
    return text if text.isascii() else text.encode("utf-8", "replace").decode()


@lru_cache(maxsize=65536)
def ends_of(connection: str) -> tuple[str, str, str]:
    """Return topic, publisher and subscriber of the text form of the id of a connection; unknown ones are empty."""
    return connection_ends(EntityId.parse(connection))


class _Line(msgspec.Struct):
    state: str = UNJUDGED
    rate: str = ""
    latency: str = ""


class GraphPicture:
    """Draws one graph after the other; what stays in it stays in its place."""

    def __init__(self, short: Callable[[str], str]) -> None:
        """``short`` makes a name that can be shown of one that came from outside."""
        self._short = short
        self._places = Places()

    def of(self, graph: Graph, rows: Sequence[Row], verdicts: Iterable[Verdict] = ()) -> Picture:
        """Return the picture of what the graph and the tree know; nodes are shown as they are judged themselves."""
        states = _states(graph, rows, verdicts)
        lines = _lines(graph, rows)
        topics, left_out = _topics(rows, lines)
        nodes = _nodes(graph, rows, lines)
        groups = _groups(topics, lines)
        if len(nodes) + len(groups) > MOST_DRAWN:
            nodes, groups, left_out = _only_bad(nodes, groups, lines, states)
        items = [(node, (node,)) for node in nodes] + [(group[0], group) for group in groups]
        place_of = {member: place for place, (_, members) in enumerate(items) for member in members}
        links = _links(lines, place_of)
        columns = {first: int(first.startswith("topic:")) for first, _ in items}
        places = self._places.of(columns, ((items[one.start][0], items[one.end][0]) for one in links))
        links = [self._led(link, items[link.start][0], items[link.end][0]) for link in links]
        drawn = tuple(self._item(members, places[first], states) for first, members in items)
        return Picture(self._places.version, self._places.width, self._places.height, drawn, tuple(links), left_out)

    def _led(self, link: Link, start: str, end: str) -> Link:
        via = self._places.ways.get((start, end))
        return msgspec.structs.replace(link, via=via) if via else link

    def _item(self, members: Sequence[str], place: tuple[float, float], states: dict[str, str]) -> Item:
        first = members[0]
        kind, _, name = first.partition(":")
        state = max((states.get(one, UNJUDGED) for one in members), key=_WORSE.__getitem__)
        return Item(first, self._short(name), kind, *place, state, tuple(members[1:]))


def _states(graph: Graph, rows: Iterable[Row], verdicts: Iterable[Verdict]) -> dict[str, str]:
    there = {encodable(f"node:{one.name}") for one in graph.nodes}
    found: dict[str, str] = {}
    for row in rows:
        state = row.state
        if row.kind == "node" and there and row.entity not in there:
            # Of a node that was there nothing is known but that.
            state = max("unknown", state, key=_WORSE.__getitem__)
        found[row.entity] = max(found.get(row.entity, UNJUDGED), state, key=_WORSE.__getitem__)
    for one in verdicts:
        if one.entity.kind is EntityKind.NODE and one.state.bad:
            entity = encodable(str(one.entity))
            found[entity] = max(found.get(entity, UNJUDGED), one.state.value, key=_WORSE.__getitem__)
    return found


def _lines(graph: Graph, rows: Iterable[Row]) -> dict[tuple[str, str], _Line]:
    """Return every line from a node to a topic and from a topic to a node."""
    lines: dict[tuple[str, str], _Line] = {}
    for one in graph.endpoints:
        ends = _ends(one)
        if ends is not None:
            lines.setdefault(ends, _Line())
    node = ""
    for row in rows:
        if row.kind == "node":
            node = row.entity
        elif row.kind == "topic" and node and node != "node:":
            line = lines.setdefault((node, row.entity), _Line())
            line.state, line.rate, line.latency = row.state, row.shown.get("rate", ""), ""
        elif row.kind == "connection":
            topic, _, subscriber = ends_of(row.entity)
            if subscriber:
                line = lines.setdefault((f"topic:{topic}", f"node:{subscriber}"), _Line(row.state))
                line.state = max(line.state, row.state, key=_WORSE.__getitem__)
                line.rate, line.latency = row.shown.get("rate", ""), row.shown.get("latency", "")
    return lines


def _ends(endpoint: Endpoint) -> tuple[str, str] | None:
    node, topic = encodable(f"node:{endpoint.node}"), encodable(f"topic:{endpoint.name}")
    if endpoint.role is _PUBLISHES:
        return node, topic
    return (topic, node) if endpoint.role is _SUBSCRIBES else None


def _nodes(graph: Graph, rows: Iterable[Row], lines: Iterable[tuple[str, str]]) -> list[str]:
    found = {one.entity for one in rows if one.kind == "node"}
    found |= {encodable(f"node:{one.name}") for one in graph.nodes}
    found |= {end for line in lines for end in line if end.startswith("node:")}
    return sorted(found - {"node:"})


def _topics(rows: Iterable[Row], lines: Iterable[tuple[str, str]]) -> tuple[list[str], str]:
    everything = {row.entity for row in rows if row.kind == "topic"}
    everything |= {end for line in lines for end in line if end.startswith("topic:")}
    shown = sorted(one for one in everything if one.removeprefix("topic:") not in PLUMBING)
    hidden = sorted(one.removeprefix("topic:") for one in everything.difference(shown))
    return shown, f"Not drawn: {', '.join(hidden)}" if hidden else ""


def _groups(topics: Sequence[str], lines: Iterable[tuple[str, str]]) -> list[tuple[str, ...]]:
    if len(topics) <= MOST_APART:
        return [(topic,) for topic in topics]
    joined: dict[str, list[tuple[str, str]]] = {topic: [] for topic in topics}
    for line in sorted(lines):
        for end in line:
            if end in joined:
                joined[end].append(("", line[1]) if end == line[0] else (line[0], ""))
    groups: dict[tuple[tuple[str, str], ...], list[str]] = {}
    for topic in topics:
        groups.setdefault(tuple(joined[topic]), []).append(topic)
    return [tuple(group) for group in groups.values()]


def _only_bad(
    nodes: Sequence[str],
    groups: Sequence[tuple[str, ...]],
    lines: Iterable[tuple[str, str]],
    states: dict[str, str],
) -> tuple[list[str], list[tuple[str, ...]], str]:
    """Return what is bad and what it hangs together with, for graphs that nobody could look at."""
    bad = {entity for entity, state in states.items() if state != UNJUDGED and State(state).bad}
    near = bad | {end for line in lines if bad.intersection(line) for end in line}
    kept_nodes = [node for node in nodes if node in near][: MOST_DRAWN // 2]
    kept = [group for group in groups if near.intersection(group)][: MOST_DRAWN // 2]
    total, drawn = len(nodes) + len(groups), len(kept_nodes) + len(kept)
    return kept_nodes, kept, f"{drawn:,} of {total:,} are drawn: what is bad and what it is joined to"


def _links(lines: dict[tuple[str, str], _Line], place_of: dict[str, int]) -> list[Link]:
    found: dict[tuple[int, int], Link] = {}
    for (start, end), line in sorted(lines.items(), key=lambda pair: pair[0]):
        if start not in place_of or end not in place_of:
            continue
        key = place_of[start], place_of[end]
        known = found.get(key)
        if known is None:
            found[key] = Link(*key, line.state, line.rate, line.latency)
        else:
            # Lines of topics that are drawn as one have no rate of their own.
            found[key] = Link(*key, max(known.state, line.state, key=_WORSE.__getitem__))
    return list(found.values())
