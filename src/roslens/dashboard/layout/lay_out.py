"""The package graph as a picture: depth columns from left to right, foundations first."""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec

from roslens.dashboard.layout.order import route, untangle
from roslens.dashboard.layout.place import spread
from roslens.dashboard.layout.tiers import Edge, cycles_of, needs_of, reduce_edges, tiers_of

DRAWN_UP_TO = 300
"""More packages than this: their edges would be a grey wedge, so only those of the selection are drawn."""

GAP = 56.0
LABEL = 15.0
ROOM = 12.0
WAY = 9.0
ASPECT = 1.6
SCREEN = 1.75
WIDEST = 1.5
TALLEST = 2.4
HEAD = 44.0


class Node(msgspec.Struct, frozen=True):
    """A node to place: radius of its disc and width of its label, in the units of the picture."""

    radius: float
    label: float


class ColumnHead(msgspec.Struct, frozen=True):
    """The columns of one tier: from where to where. Tier -1 holds what is linked to nothing."""

    tier: int
    left: float
    right: float
    top: float


class Drawn(msgspec.Struct, frozen=True):
    """An edge as drawn: who needs whom, and the SVG path. ``cycle`` is whether both need each other."""

    dependent: int
    needed: int
    path: str
    cycle: bool = False


class Layout(msgspec.Struct, frozen=True):
    """Where everything stands. ``edges`` is empty for graphs too large to draw all of them."""

    width: float
    height: float
    places: tuple[tuple[float, float], ...]
    tiers: tuple[int, ...]
    columns: tuple[int, ...]
    cycles: tuple[int, ...]
    heads: tuple[ColumnHead, ...]
    edges: tuple[Drawn, ...]
    reduced: tuple[Edge, ...]


def lay_out(nodes: Sequence[Node], edges: Sequence[Edge]) -> Layout:
    """Place ``nodes``, given in the order that decides ties; an edge (a, b) means that a needs b."""
    needs = needs_of(len(nodes), edges)
    component = cycles_of(needs)
    tiers = tiers_of(needs, component)
    reduced = reduce_edges(needs, component)
    linked = {end for edge in reduced for end in edge}
    alone = [node for node in range(len(nodes)) if node not in linked]
    columns = _columns(nodes, tiers, linked, needs)
    routed = [edge for edge in reduced if tiers[edge[0]] != tiers[edge[1]]]
    drawn = len(nodes) <= DRAWN_UP_TO
    grid = route([members for _, members in columns], len(nodes), routed if drawn else ())
    order = untangle(grid)
    heights = [_room(node) for node in nodes] + [WAY] * (len(grid.left) - len(nodes))
    spans, right = _spans(nodes, [members for _, members in columns])
    centres = spread(order, heights, grid.left, grid.right)
    stretch = _stretch(centres, order, right)
    centres = [centre * stretch for centre in centres]
    spans, right = _widened(spans, right, _extent(centres, order))
    top = min((centres[item] - heights[item] / 2 for column in order for item in column), default=0.0)
    places: list[tuple[float, float]] = [(0.0, 0.0)] * len(nodes)
    numbers = [-1] * len(nodes)
    bottom = 0.0
    for number, column in enumerate(order):
        for item in column:
            centre = centres[item] - top + HEAD
            bottom = max(bottom, centre + heights[item] / 2)
            if item < len(nodes):
                numbers[item] = number
                places[item] = (round(sum(spans[number]) / 2, 1), round(centre - LABEL / 2, 1))
    heads = _heads([tier for tier, _ in columns], spans)
    right, bottom = _place_alone(nodes, alone, places, heads, right, bottom)
    heights_of_ways = [round(centre - top + HEAD - LABEL / 2, 1) for centre in centres]
    paths = [_path(way, places, nodes, heights_of_ways, spans, numbers) for way in grid.ways]
    pictured = [Drawn(*edge, path) for edge, path in zip(routed, paths, strict=False)] if drawn else []
    if drawn:
        inside = [edge for edge in reduced if tiers[edge[0]] == tiers[edge[1]]]
        pictured += [Drawn(*edge, _arc(edge, places, nodes), cycle=True) for edge in inside]
    return Layout(
        width=round(right, 1),
        height=round(bottom + ROOM, 1),
        places=tuple(places),
        tiers=tuple(tiers),
        columns=tuple(numbers),
        cycles=tuple(component),
        heads=tuple(heads),
        edges=tuple(pictured),
        reduced=tuple(reduced),
    )


def _stretch(centres: Sequence[float], order: Sequence[Sequence[int]], right: float) -> float:
    """Return by how much to pull the rows of a low and wide picture apart, so that names have room on a screen."""
    height = _extent(centres, order)
    return min(TALLEST, max(1.0, right / ASPECT / height)) if height > 0 else 1.0


def _extent(centres: Sequence[float], order: Sequence[Sequence[int]]) -> float:
    found = [centres[item] for column in order for item in column]
    return max(found, default=0.0) - min(found, default=0.0)


def _widened(
    spans: Sequence[tuple[float, float]], right: float, height: float
) -> tuple[list[tuple[float, float]], float]:
    """Return the columns of a tall picture further apart, so that it fills a screen and names have room beside it."""
    between = len(spans) - 1
    if between < 1:
        return list(spans), right
    more = min(WIDEST * GAP, max(0.0, (height * SCREEN - right) / between))
    return [
        (left + place * more, end + place * more) for place, (left, end) in enumerate(spans)
    ], right + between * more


def _room(node: Node) -> float:
    return 2 * node.radius + LABEL + ROOM


def _columns(
    nodes: Sequence[Node], tiers: Sequence[int], linked: set[int], needs: Sequence[Sequence[int]]
) -> list[tuple[int, list[int]]]:
    """Return (tier, members) of each column; a tall tier takes several columns so that the picture fits a screen."""
    members: dict[int, list[int]] = {}
    for node in sorted(linked):
        members.setdefault(tiers[node], []).append(node)
    asked = [0] * len(nodes)
    for targets in needs:
        for target in targets:
            asked[target] += 1
    rows = _rows([len(column) for column in members.values()], nodes)
    columns = []
    for tier in sorted(members):
        count = math.ceil(len(members[tier]) / rows)
        size = math.ceil(len(members[tier]) / count)
        # What many need stands nearest to those that need it.
        ranked = sorted(members[tier], key=lambda node: (asked[node], node))
        columns += [(tier, sorted(ranked[start : start + size])) for start in range(0, len(ranked), size)]
    return columns


def _rows(sizes: Sequence[int], nodes: Sequence[Node]) -> int:
    """Return how many nodes a column may hold for a picture about ``ASPECT`` times as wide as high."""
    if not sizes:
        return 1
    width = GAP + sum(max(2 * node.radius, node.label) for node in nodes) / len(nodes)
    height = sum(_room(node) for node in nodes) / len(nodes)

    def misfit(rows: int) -> tuple[float, int]:
        columns = sum(math.ceil(size / rows) for size in sizes)
        return (abs(math.log(columns * width / (min(rows, max(sizes)) * height) / ASPECT)), -rows)

    return min(range(min(6, max(sizes)), max(sizes) + 1), key=misfit)


def _spans(nodes: Sequence[Node], columns: Sequence[Sequence[int]]) -> tuple[list[tuple[float, float]], float]:
    spans = []
    left = GAP / 2
    for column in columns:
        width = max((max(2 * nodes[node].radius, nodes[node].label) for node in column), default=0.0)
        spans.append((left, left + width))
        left += width + GAP
    return spans, max(left - GAP / 2, GAP)


def _heads(tiers: Sequence[int], spans: Sequence[tuple[float, float]]) -> list[ColumnHead]:
    heads: list[ColumnHead] = []
    for tier, (left, right) in zip(tiers, spans, strict=True):
        if heads and heads[-1].tier == tier:
            heads[-1] = ColumnHead(tier, heads[-1].left, right, 0.0)
        else:
            heads.append(ColumnHead(tier, left, right, 0.0))
    return heads


def _place_alone(
    nodes: Sequence[Node],
    alone: Sequence[int],
    places: list[tuple[float, float]],
    heads: list[ColumnHead],
    right: float,
    bottom: float,
) -> tuple[float, float]:
    """Put what is linked to nothing into rows below the rest; return the new right and bottom ends."""
    if not alone:
        return right, bottom
    width = max(max(2 * nodes[node].radius, nodes[node].label) for node in alone) + GAP / 2
    height = max(_room(nodes[node]) for node in alone)
    wanted = math.ceil(math.sqrt(len(alone) * height * ASPECT / width))
    per_row = max(1, int((right - GAP / 2) // width), 1 if heads else wanted)
    top = bottom + (HEAD if heads else 0)
    heads.append(ColumnHead(-1, GAP / 2, GAP / 2 + width * min(per_row, len(alone)), round(top, 1)))
    for place, node in enumerate(alone):
        row, column = divmod(place, per_row)
        places[node] = (round(GAP / 2 + (column + 0.5) * width, 1), round(top + HEAD + (row + 0.5) * height, 1))
    rows = math.ceil(len(alone) / per_row)
    return max(right, GAP / 2 + width * min(per_row, len(alone)) + GAP / 2), top + HEAD + rows * height


def _path(
    way: Sequence[int],
    places: Sequence[tuple[float, float]],
    nodes: Sequence[Node],
    heights: Sequence[float],
    spans: Sequence[tuple[float, float]],
    numbers: Sequence[int],
) -> str:
    """Return a line that runs level through columns and bends between them."""
    first, last = way[0], way[-1]
    x, y = places[first]
    parts = [f"M{x + nodes[first].radius:.1f} {y:.1f}"]
    for step, item in enumerate(way[1:], 1):
        start, end = spans[numbers[first] + step - 1][1], spans[numbers[first] + step][0]
        height = places[item][1] if item == last else heights[item]
        middle = (start + end) / 2
        parts.append(f"H{start:.1f}C{middle:.1f} {y:.1f} {middle:.1f} {height:.1f} {end:.1f} {height:.1f}")
        y = height
    parts.append(f"H{places[last][0] - nodes[last].radius:.1f}")
    return "".join(parts)


def _arc(edge: Edge, places: Sequence[tuple[float, float]], nodes: Sequence[Node]) -> str:
    """Return a bow beside the column, for two that need each other."""
    (x1, y1), (x2, y2) = places[edge[0]], places[edge[1]]
    x1, x2 = x1 + nodes[edge[0]].radius, x2 + nodes[edge[1]].radius
    out = max(x1, x2) + 24
    return f"M{x1:.1f} {y1:.1f}C{out:.1f} {y1:.1f} {out:.1f} {y2:.1f} {x2:.1f} {y2:.1f}"
