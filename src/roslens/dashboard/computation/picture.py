"""The computation graph as values that a page draws: topics as elements of their own, or as lines between nodes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import msgspec

from roslens.dashboard.computation.flow import tiers
from roslens.dashboard.computation.lay_out import Box, Item, Picture, lay_out
from roslens.dashboard.computation.noise import DEFAULT, IMPLICIT, matches
from roslens.dashboard.computation.system import Element, Kind, System, relative

CHARACTER = 6.7
NODE_HEIGHT = 26.0
MARK_HEIGHT = 18.0
MARK = 20.0
"""Room that the mark of a topic, service or action takes before its name."""

LONGEST = 32
MANY = 140
"""More elements than this are first shown with topics as lines."""

_ASPECT = 1.7


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
    lanes = tuple(sorted({element.lane for element in system.elements}, key=_lane_order))
    node_tiers = _node_tiers(system)
    columns = _columns(system, node_tiers)
    sized = [_size(element) for element in system.elements]
    items = [
        Item(*sized[number], lanes.index(element.lane), columns[number])
        for number, element in enumerate(system.elements)
    ]
    wires = tuple(
        Line(w.source, w.target, conditional=w.conditional, resolved=w.resolved, implicit=w.implicit, sure=w.sure)
        for w in system.wires
    )
    flows = _flows(system)
    visible = visible_of(system, left)
    everything = lay_out(items, [(wire.source, wire.target) for wire in wires], lanes)
    topics = _drawing(items, wires, visible, lanes, left)
    nodes = {number for number in visible if system.elements[number].kind is Kind.NODE}
    on_tiers = [
        msgspec.structs.replace(item, column=node_tiers[number]) if number < len(node_tiers) else item
        for number, item in enumerate(items)
    ]
    kept = tuple(
        msgspec.structs.replace(flow, by=by)
        for flow in flows
        if (by := tuple(one for one in flow.by if one in visible))
    )
    lines = _drawing(on_tiers, kept, nodes, lanes, left)
    marks = tuple(
        Mark(
            element.key,
            element.name,
            label_of(element),
            element.kind.value,
            *sized[number],
            items[number].lane,
            columns[number],
            everything.rows[number],
            node_tiers[number] if number < len(node_tiers) else 0,
            element.sure,
            element.noise,
            element.severity,
        )
        for number, element in enumerate(system.elements)
    )
    return ComputationGraph(lanes, marks, wires, kept, topics, lines, many=len(visible) > MANY)


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


def label_of(element: Element) -> str:
    """Return the name as it stands in the box of its namespace; of a long one the middle is left out."""
    name = relative(element.name, element.lane)
    if element.program:
        name = f"{name} ({element.program})"
    if len(name) <= LONGEST:
        return name
    return name[:12] + "\N{HORIZONTAL ELLIPSIS}" + name[13 - LONGEST :]


def _lane_order(name: str) -> tuple[str, ...]:
    return tuple(part for part in name.split("/") if part)


def _size(element: Element) -> tuple[float, float]:
    width = len(label_of(element)) * CHARACTER
    if element.kind is Kind.NODE:
        return round(max(48.0, width + 24), 1), NODE_HEIGHT
    return round(MARK + width + 4, 1), MARK_HEIGHT


def _through(system: System) -> dict[tuple[int, int], list[int]]:
    """Return what flows from node to node, as the topics, services and actions by which it does."""
    giving: dict[int, list[int]] = {}
    taking: dict[int, list[int]] = {}
    nodes = len(system.nodes)
    for wire in system.wires:
        if wire.source < nodes:
            giving.setdefault(wire.target, []).append(wire.source)
        else:
            taking.setdefault(wire.source, []).append(wire.target)
    found: dict[tuple[int, int], list[int]] = {}
    for channel, sources in sorted(giving.items()):
        for source in sources:
            for target in taking.get(channel, ()):
                found.setdefault((source, target), []).append(channel)
    return found


def _node_tiers(system: System) -> list[int]:
    count = len(system.nodes)
    quiet = {number for number, element in enumerate(system.elements) if DEFAULT.intersection(element.noise)}
    flows = {
        pair: len(told)
        for pair, channels in _through(system).items()
        if (told := [channel for channel in channels if channel not in quiet]) and pair[0] != pair[1]
    }
    most = max(3, round((len(system.elements) / 4) ** 0.5 * _ASPECT / 2))
    found = tiers(count, flows, most)
    linked = {end for pair in flows for end in pair}
    wide = 1 + max((found[node] for node in linked), default=0)
    alone = [node for node in range(count) if node not in linked]
    for place, node in enumerate(alone):
        found[node] = place % wide
    return found


def _columns(system: System, node_tiers: list[int]) -> list[int]:
    """Return columns: what joins nodes stands right behind who gives it, or before the first that takes it."""
    nodes = len(system.nodes)
    giving: dict[int, list[int]] = {}
    taking: dict[int, list[int]] = {}
    for wire in system.wires:
        if wire.source < nodes:
            giving.setdefault(wire.target, []).append(node_tiers[wire.source])
        else:
            taking.setdefault(wire.source, []).append(node_tiers[wire.target])
    found = [2 * tier + 1 for tier in node_tiers]
    for channel in range(nodes, len(system.elements)):
        if channel in giving:
            before = [tier for tier in giving[channel] if tier < max(taking.get(channel, [99]))]
            found.append(2 * max(before or giving[channel]) + 2)
        else:
            found.append(2 * min(taking[channel]))
    used = {column: place for place, column in enumerate(sorted(set(found)))}
    return [used[column] for column in found]


def _flows(system: System) -> tuple[Line, ...]:
    shaky = {(wire.source, wire.target): wire for wire in system.wires}
    found = []
    for (source, target), channels in sorted(_through(system).items()):
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


def _drawing(
    items: list[Item], lines: Iterable[Line], visible: set[int], lanes: tuple[str, ...], left: Left
) -> Drawing:
    """Return the picture of what is visible, columns closed up."""
    order = sorted(visible)
    number = {old: new for new, old in enumerate(order)}
    used = {column: place for place, column in enumerate(sorted({items[old].column for old in order}))}
    kept = [msgspec.structs.replace(items[old], column=used[items[old].column]) for old in order]
    drawn = [
        (place, line)
        for place, line in enumerate(lines)
        if line.source in visible and line.target in visible and not (line.implicit and IMPLICIT in left.presets)
    ]
    picture: Picture = lay_out(kept, [(number[line.source], number[line.target]) for _, line in drawn], lanes)
    return Drawing(
        picture.width,
        picture.height,
        {old: picture.places[new] for new, old in enumerate(order)},
        picture.boxes,
        tuple((place, path) for (place, _), path in zip(drawn, picture.paths, strict=True)),
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
