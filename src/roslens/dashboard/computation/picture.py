"""The computation graph as values that a page draws: topics as elements of their own, or as lines between nodes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import msgspec

from roslens.dashboard.computation.noise import DEFAULT, IMPLICIT, matches
from roslens.dashboard.computation.system import Kind, System
from roslens.dashboard.computation.system import Wire as SystemWire
from roslens.dashboard.plan.columns import closed_up, columns_of, through, tiers_of
from roslens.dashboard.plan.ground import Box, Ground, Part, Wire, parts_of
from roslens.dashboard.plan.mark import label_of, part_of
from roslens.dashboard.plan.plan import ground_of, plan
from roslens.dashboard.plan.survey import survey
from roslens.model.graph import Role

_PROVIDE = frozenset({Role.PUBLISHER, Role.SERVICE_SERVER, Role.ACTION_SERVER})
MANY = 140
"""More elements than this are first shown with topics as lines."""


class Left(msgspec.Struct, frozen=True):
    """What is left out: presets of noise, and names by pattern."""

    presets: frozenset[str] = DEFAULT
    patterns: tuple[str, ...] = ()


class Mark(msgspec.Struct, frozen=True):
    """An element as drawn: its name as it stands in its box, size, lane, column and row; what it is joined to."""

    id: str
    name: str
    label: str
    kind: str
    w: float
    h: float
    lane: int
    column: int
    row: int
    tier: int
    sure: str
    noise: tuple[str, ...]
    severity: str


class Line(msgspec.Struct, frozen=True):
    """A wire between two elements, or between two nodes by the topics, services and actions ``by``."""

    source: int
    target: int
    by: tuple[int, ...] = ()
    conditional: bool = False
    resolved: bool = True
    implicit: bool = False
    sure: str = "certain"


class Drawing(msgspec.Struct, frozen=True):
    """A way to draw the graph: its size, where each visible element stands, boxes, lines with their paths."""

    width: float
    height: float
    places: dict[int, tuple[float, float]]
    boxes: tuple[Box, ...]
    lines: tuple[tuple[int, str], ...]


class ComputationGraph(msgspec.Struct, frozen=True):
    """Everything that picture and script need."""

    lanes: tuple[str, ...]
    marks: tuple[Mark, ...]
    wires: tuple[Line, ...]
    flows: tuple[Line, ...]
    topics: Drawing
    lines: Drawing
    many: bool


def computation_graph(system: System, left: Left | None = None) -> ComputationGraph:
    """Return the graph; what ``left`` means is not visible and has no place, but a column and a row."""
    left = left or Left()
    parts = parts_in(system)
    wires = tuple(
        Line(w.source, w.target, conditional=w.conditional, resolved=w.resolved, implicit=w.implicit, sure=w.sure)
        for w in system.wires
    )
    flows = _flows(system, parts)
    visible = visible_of(system, left)
    tiers = tiers_of(parts, _keys(parts, wires))
    kept = tuple(
        msgspec.structs.replace(flow, by=by)
        for flow in flows
        if (by := tuple(one for one in flow.by if one in visible))
    )
    drawn = _drawn(wires, visible, left)
    topics = _drawing(_marks_ground(parts, visible, wires, left), parts, visible, drawn)
    nodes = {number for number in visible if parts[number].node}
    lines = _drawing(_lines_ground(parts, nodes, kept, tiers), parts, nodes, _drawn(kept, nodes, left))
    lanes = tuple(sorted({part.lane for part in parts}, key=parts_of))
    columns = columns_of(parts, _keys(parts, wires))
    rows = _rows(parts, wires, topics)
    marks = tuple(
        Mark(
            element.key,
            element.name,
            label_of(element.name, element.lane, element.program),
            element.kind.value,
            part.width,
            part.height,
            lanes.index(part.lane),
            columns[number],
            rows[number],
            tiers.get(number, 0),
            element.sure,
            element.noise,
            element.severity,
        )
        for number, (element, part) in enumerate(zip(system.elements, parts, strict=True))
    )
    return ComputationGraph(lanes, marks, wires, kept, topics, lines, many=len(visible) > MANY)


class Grounds(NamedTuple):
    """Where elements stand with topics as marks and as lines between nodes; ``many`` where lines are shown first."""

    marks: Ground
    lines: Ground
    many: bool


def grounds_of(system: System) -> Grounds:
    """Return where the elements stand until a reader chooses otherwise."""
    left = Left()
    parts = parts_in(system)
    visible = visible_of(system, left)
    flows = [flow for flow in _flows(system, parts) if any(one in visible for one in flow.by)]
    nodes = {number for number in visible if parts[number].node}
    tiers = tiers_of(parts, _keys(parts, system.wires))
    marks = _marks_ground(parts, visible, system.wires, left)
    return Grounds(marks, _lines_ground(parts, nodes, flows, tiers), many=len(visible) > MANY)


def parts_in(system: System) -> tuple[Part, ...]:
    """Return the elements as parts of a plan, by the names that what runs would have."""
    hosts = _hosts(system)
    taken: dict[str, int] = {}
    found = []
    for element, host in zip(system.elements, hosts, strict=True):
        name = f"{element.kind.value}:{element.name}"
        taken[name] = taken.get(name, 0) + 1
        key = name if taken[name] == 1 else f"{name}~{taken[name]}"
        quiet = bool(DEFAULT.intersection(element.noise))
        found.append(part_of(key, element.name, element.lane, element.program, host=host, quiet=quiet))
    return tuple(found)


def _hosts(system: System) -> list[str]:
    """Return on which machine each element would be; empty where there is one only, or nodes of several provide it.

    A topic is where it is published, a service or action where it is served; what nobody provides is where it is used.
    """
    machines = [node.machine or "of the launch" for node in system.nodes]
    if len(set(machines)) < 2:
        return [""] * len(system.elements)
    users: dict[int, set[str]] = {}
    providers: dict[int, set[str]] = {}
    for end in system.ends:
        users.setdefault(end.channel, set()).add(machines[end.node])
        if end.configured.endpoint.role in _PROVIDE:
            providers.setdefault(end.channel, set()).add(machines[end.node])
    at = {**users, **providers}
    others = range(len(machines), len(system.elements))
    return [*machines, *(next(iter(at[one])) if len(at.get(one, ())) == 1 else "" for one in others)]


def _keys(parts: Sequence[Part], lines: Sequence[Line | SystemWire]) -> list[Wire]:
    return [(parts[line.source].key, parts[line.target].key) for line in lines]


def _drawn(lines: Sequence[Line], visible: set[int], left: Left) -> list[tuple[int, Line]]:
    return [(place, line) for place, line in enumerate(lines) if _is_drawn(line, visible, left)]


def _is_drawn(line: Line | SystemWire, visible: set[int], left: Left) -> bool:
    return line.source in visible and line.target in visible and not (line.implicit and IMPLICIT in left.presets)


def _marks_ground(parts: Sequence[Part], visible: set[int], wires: Sequence[Line | SystemWire], left: Left) -> Ground:
    kept = [wire for wire in wires if _is_drawn(wire, visible, left)]
    return ground_of([parts[number] for number in sorted(visible)], _keys(parts, kept))


def _lines_ground(parts: Sequence[Part], nodes: set[int], flows: Sequence[Line], tiers: Mapping[int, int]) -> Ground:
    numbers = sorted(nodes, key=lambda number: parts[number].key)
    columns = closed_up([tiers[number] for number in numbers])
    kept = [flow for flow in flows if flow.source in nodes and flow.target in nodes]
    return survey([parts[number] for number in numbers], columns, _keys(parts, kept))


def _rows(parts: Sequence[Part], wires: Sequence[Line], topics: Drawing) -> list[int]:
    """Return the order from top to bottom; what has no place stands beside what it is joined to."""
    heights = {number: place[1] for number, place in topics.places.items()}
    near: dict[int, list[float]] = {}
    for wire in wires:
        for one, other in ((wire.source, wire.target), (wire.target, wire.source)):
            if one not in heights and other in heights:
                near.setdefault(one, []).append(heights[other])
    wanted = [heights.get(number, _mean(near.get(number, ()))) for number in range(len(parts))]
    rows = [0] * len(parts)
    for row, number in enumerate(sorted(range(len(parts)), key=lambda number: (wanted[number], parts[number].key))):
        rows[number] = row
    return rows


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values) if values else 0.0


def visible_of(system: System, left: Left) -> set[int]:
    """Return the elements that are not left out; a topic that no visible wire ends at is left out too."""
    joined = set()
    for wire in system.wires:
        if not (wire.implicit and IMPLICIT in left.presets):
            joined |= {wire.source, wire.target}
    return {
        number
        for number, element in enumerate(system.elements)
        if not left.presets.intersection(element.noise)
        and not matches(element.name, left.patterns)
        and (element.kind is Kind.NODE or number in joined)
    }


def _flows(system: System, parts: Sequence[Part]) -> tuple[Line, ...]:
    shaky = {(wire.source, wire.target): wire for wire in system.wires}
    found = []
    for (source, target), channels in sorted(through(parts, _keys(parts, system.wires)).items()):
        if source == target:
            continue
        pairs = [(shaky[source, channel], shaky[channel, target]) for channel in channels]
        found.append(
            Line(
                source,
                target,
                tuple(channels),
                conditional=all(give.conditional or take.conditional for give, take in pairs),
                resolved=any(give.resolved and take.resolved for give, take in pairs),
                implicit=all(give.implicit or take.implicit for give, take in pairs),
            )
        )
    return tuple(found)


def _drawing(ground: Ground, parts: Sequence[Part], visible: set[int], drawn: Sequence[tuple[int, Line]]) -> Drawing:
    order = sorted(visible)
    found = plan(ground, [parts[number] for number in order], _keys(parts, [line for _, line in drawn]))
    return Drawing(
        found.width,
        found.height,
        dict(zip(order, found.places, strict=True)),
        found.boxes,
        tuple((place, path) for (place, _), path in zip(drawn, found.paths, strict=True)),
    )


def style_of(line: Line | Mapping[str, object]) -> str:
    """Return the classes of a line."""
    if isinstance(line, Mapping):
        line = msgspec.convert(line, Line)
    return " ".join(
        name
        for name, held in (
            ("conditional", line.conditional),
            ("unresolved", not line.resolved),
            (line.sure, line.sure != "certain"),
        )
        if held
    )
