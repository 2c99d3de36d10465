"""The graph as the live page draws it: who publishes what to whom, with the state and rate of each line."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import NamedTuple

from roslens.cli.page.drawn_lines import DrawnLines
from roslens.cli.page.half_lines import Ends, HalfLine, encodable, half_lines, joined_by, worse
from roslens.cli.page.whole_lines import whole_lines
from roslens.dashboard.computation.noise import DEFAULT, kinds_of_noise
from roslens.dashboard.computation.picture import MANY, Grounds
from roslens.dashboard.live.snapshot import UNJUDGED, Item, Link, Picture, Row
from roslens.dashboard.plan.ground import Ground, Part
from roslens.dashboard.plan.mark import label_of, lane_of, namespace_of, part_of
from roslens.dashboard.plan.plan import Plan
from roslens.dashboard.plan.sheet import NOWHERE, Sheet
from roslens.model.entity import EntityKind
from roslens.model.graph import Graph
from roslens.model.verdict import State, Verdict

PLUMBING = frozenset({"/rosout", "/rosout_agg", "/parameter_events"})
"""Topics that join every node to every other and say nothing of the system."""
MOST_DRAWN = 1500
_PAST = 500_000_000
"""Pictures of other moments have versions from here on, so that no page takes one for a picture of the present."""


def no_grounds(nodes: Collection[str]) -> Grounds | None:  # noqa: ARG001 - the shape of what knows the source
    """Return that nothing is known of the source of what runs."""
    return None


class Base(NamedTuple):
    """On which pictures of other moments are drawn: a ground, and whether lines stand for topics there."""

    ground: Ground
    as_lines: bool


class GraphPicture:
    """Draws one graph after the other; what stays in it stays in its place.

    Where the source of what runs is known, everything stands where the page of that source has it.

    Attributes:
        base: for pictures of other moments; None before the first picture.
    """

    def __init__(
        self, short: Callable[[str], str], grounds: Callable[[Collection[str]], Grounds | None] = no_grounds
    ) -> None:
        """Draw on an empty sheet.

        Args:
            short: makes a name that can be shown of one that came from outside.
            grounds: gives where the source of nodes has them, by their entities; None where it is not known.
        """
        self._short = short
        self._grounds = grounds
        self._sheet = Sheet()
        self._joined: tuple[Graph, tuple[Ends, ...]] | None = None
        self._drawn: DrawnLines | None = None
        self._hosts = False
        self._nodes: Collection[str] = ()
        self._homes: dict[str, str] = {}
        self.base: Base | None = None

    def of(self, graph: Graph, rows: Sequence[Row], verdicts: Iterable[Verdict] = ()) -> Picture:
        """Return the picture of what the graph and the tree know; nodes are shown as they are judged themselves."""
        judged = _judged_nodes(verdicts)
        if self._drawn is not None:
            grounds = None if self._hosts else self._grounds(self._nodes)
            if self._drawn.follow(graph, rows, judged, grounds):
                return self._drawn.picture
        return self._anew(graph, rows, judged)

    def _anew(self, graph: Graph, rows: Sequence[Row], judged: Mapping[str, str]) -> Picture:
        states = _states(graph, rows, judged)
        if self._joined is None or self._joined[0] is not graph:
            self._joined = graph, joined_by(graph)
        halves = half_lines(self._joined[1], rows)
        topics, left_out = _topics(rows, halves)
        nodes = _nodes(graph, rows, halves)
        hosts = _hosts(rows)
        self._hosts, self._nodes = bool(hosts), nodes
        grounds = None if hosts else self._grounds(nodes)
        as_lines = self._as_lines(grounds, len(nodes) + len(topics))
        if len(nodes) + (0 if as_lines else len(topics)) > MOST_DRAWN:
            nodes, topics, left_out = _only_bad(nodes, topics, halves, states)
        lines: dict[Ends, tuple[HalfLine, list[str]]]
        if as_lines:
            whole, loose, many = whole_lines(halves, topics)
            bad = [topic for topic in loose if _bad(states.get(topic, UNJUDGED))]
            topics, left_out = bad, _reported(left_out, many)
            lines = {ends: (one.line, one.by) for ends, one in whole.items()}
        else:
            lines = {}
        drawn = [*nodes, *topics]
        place_of = {entity: place for place, entity in enumerate(drawn)}
        lines |= {ends: (line, []) for ends, line in halves.items() if {*ends} <= place_of.keys()}
        ends = sorted(pair for pair in lines if {*pair} <= place_of.keys())
        self._homes = _homes(ends, hosts, self._homes) if hosts else {}
        parts = _parts(drawn, {**self._homes, **hosts}, self._short)
        plan = self._plan(parts, ends, (grounds.lines if as_lines else grounds.marks) if grounds else NOWHERE)
        self.base = Base(self._sheet.ground, as_lines)
        items = tuple(
            self._item(entity, part, place, states)
            for entity, part, place in zip(drawn, parts, plan.places, strict=True)
        )
        links = tuple(
            _link(place_of[start], place_of[end], *lines[start, end], path, word)
            for (start, end), path, word in zip(ends, plan.paths, plan.words, strict=True)
        )
        picture = Picture(
            self._version, plan.width, plan.height, items, links, left_out, boxes=plan.boxes, as_lines=as_lines
        )
        reported = [(pair, lines[pair][1]) for pair in ends]
        self._drawn = DrawnLines(graph, rows, judged, grounds, picture, halves, reported)
        return picture

    def _as_lines(self, grounds: Grounds | None, count: int) -> bool:
        """Return whether lines between nodes stand for the topics of so many nodes and topics."""
        return grounds.many if grounds else count > MANY

    def _plan(self, parts: Sequence[Part], ends: Sequence[Ends], given: Ground) -> Plan:
        return self._sheet.of(parts, ends, given)

    @property
    def _version(self) -> int:
        return self._sheet.version

    def _item(self, entity: str, part: Part, place: tuple[float, float], states: Mapping[str, str]) -> Item:
        kind, _, name = entity.partition(":")
        lane = "/" + "/".join(one for one in part.lane.split("/") if one and not one.startswith("@"))
        state, short = states.get(entity, UNJUDGED), self._short(name)
        return Item(entity, short, kind, *place, state, label_of(short, lane), part.width, part.height)


class PastPicture(GraphPicture):
    """Draws other moments where the present has everything; what only they have keeps the place that it gets."""

    def __init__(self, short: Callable[[str], str], present: Callable[[], GraphPicture]) -> None:
        """Draw on what ``present`` gives; ``short`` makes a name that can be shown of one that came from outside."""
        super().__init__(short)
        self._present = present
        self._under: Base | None = None

    def of(self, graph: Graph, rows: Sequence[Row], verdicts: Iterable[Verdict] = ()) -> Picture:
        """Return the picture of a moment."""
        base = self._present().base
        if base is not self._under:
            self._under, self._drawn = base, None
        return super().of(graph, rows, verdicts)

    def _as_lines(self, grounds: Grounds | None, count: int) -> bool:
        return self._under.as_lines if self._under else super()._as_lines(grounds, count)

    def _plan(self, parts: Sequence[Part], ends: Sequence[Ends], given: Ground) -> Plan:
        return self._sheet.upon(parts, ends, self._under.ground if self._under else given)

    @property
    def _version(self) -> int:
        return _PAST + self._sheet.version


def _homes(ends: Iterable[Ends], hosts: Mapping[str, str], known: Mapping[str, str]) -> dict[str, str]:
    """Return the host of each topic: that of the nodes that publish it, empty where these are on several.

    So most wires between hosts are those that messages take. A topic that nobody publishes any more stays where it was
    known, one that nobody ever published is where its subscribers are.
    """
    publishers: dict[str, set[str]] = {}
    subscribers: dict[str, set[str]] = {}
    for start, end in ends:
        if start.startswith("node:") and end.startswith("topic:"):
            publishers.setdefault(end, set()).add(hosts.get(start, ""))
        elif start.startswith("topic:"):
            subscribers.setdefault(start, set()).add(hosts.get(end, ""))
    return {**_single(subscribers), **known, **_single(publishers)}


def _single(users: Mapping[str, set[str]]) -> dict[str, str]:
    return {topic: next(iter(found)) if len(found) == 1 else "" for topic, found in users.items()}


def _parts(drawn: Sequence[str], hosts: Mapping[str, str], short: Callable[[str], str]) -> list[Part]:
    lanes = {namespace_of(entity.partition(":")[2]) for entity in drawn if entity.startswith("node:")}
    found = []
    for entity in drawn:
        node = entity.startswith("node:")
        name = entity.partition(":")[2]
        lane = lane_of(name, lanes)
        host = hosts.get(entity, "")
        quiet = not node and bool(DEFAULT.intersection(kinds_of_noise(name)))
        part = part_of(entity, short(name), lane, host=host.replace("/", "-"), quiet=quiet)
        found.append(part)
    return found


def _hosts(rows: Iterable[Row]) -> dict[str, str]:
    """Return on which host each node runs; empty where all are on one."""
    found: dict[str, str] = {}
    host = ""
    for row in rows:
        if row.kind == "host":
            host = row.name
        elif row.kind == "node" and host:
            found[row.entity] = host
    return found if len(set(found.values())) > 1 else {}


def _link(start: int, end: int, line: HalfLine, by: Sequence[str], path: str, word: tuple[float, float]) -> Link:
    return Link(
        start, end, line.state, line.rate, line.latency, line.bandwidth, line.age, line.lag, tuple(by), path, word
    )


def _reported(left_out: str, many: Sequence[str]) -> str:
    """Return what is not drawn, with topics that would make too many lines."""
    if not many:
        return left_out
    names = ", ".join(topic.removeprefix("topic:") for topic in many[:5])
    more = f" and {len(many) - 5} more" if len(many) > 5 else ""
    return "; ".join(part for part in (left_out, f"join too many nodes to be drawn: {names}{more}") if part)


def _bad(state: str) -> bool:
    return state != UNJUDGED and State(state).bad


def _judged_nodes(verdicts: Iterable[Verdict]) -> dict[str, str]:
    """Return nodes that are bad by verdicts, with the worst state of each."""
    found: dict[str, str] = {}
    for one in verdicts:
        if one.state is not State.OK and one.state.bad and one.entity.kind is EntityKind.NODE:
            entity = encodable(str(one.entity))
            found[entity] = worse(found.get(entity, UNJUDGED), one.state.value)
    return found


def _states(graph: Graph, rows: Iterable[Row], judged: Mapping[str, str]) -> dict[str, str]:
    there = {encodable(f"node:{one.name}") for one in graph.nodes}
    found: dict[str, str] = {}
    for row in rows:
        state = row.state
        if row.kind == "node" and there and row.entity not in there:
            # Of a node that was there nothing is known but that.
            state = worse("unknown", state)
        found[row.entity] = worse(found.get(row.entity, UNJUDGED), state)
    for entity, state in judged.items():
        found[entity] = worse(found.get(entity, UNJUDGED), state)
    return found


def _nodes(graph: Graph, rows: Iterable[Row], lines: Iterable[Ends]) -> list[str]:
    found = {one.entity for one in rows if one.kind == "node"}
    found |= {encodable(f"node:{one.name}") for one in graph.nodes}
    found |= {end for line in lines for end in line if end.startswith("node:")}
    return sorted(found - {"node:"})


def _topics(rows: Iterable[Row], lines: Iterable[Ends]) -> tuple[list[str], str]:
    everything = {row.entity for row in rows if row.kind == "topic"}
    everything |= {end for line in lines for end in line if end.startswith("topic:")}
    shown = sorted(one for one in everything if one.removeprefix("topic:") not in PLUMBING)
    hidden = sorted(one.removeprefix("topic:") for one in everything.difference(shown))
    return shown, f"Not drawn: {', '.join(hidden)}" if hidden else ""


def _only_bad(
    nodes: Sequence[str], topics: Sequence[str], lines: Iterable[Ends], states: Mapping[str, str]
) -> tuple[list[str], list[str], str]:
    """Return what is bad and what it hangs together with, for graphs that nobody could look at."""
    bad = {entity for entity, state in states.items() if _bad(state)}
    near = bad | {end for line in lines if bad.intersection(line) for end in line}
    kept_nodes = [node for node in nodes if node in near][: MOST_DRAWN // 2]
    kept = [topic for topic in topics if topic in near][: MOST_DRAWN // 2]
    total, drawn = len(nodes) + len(topics), len(kept_nodes) + len(kept)
    return kept_nodes, kept, f"{drawn:,} of {total:,} are drawn: what is bad and what it is joined to"
