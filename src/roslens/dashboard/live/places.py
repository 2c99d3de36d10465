"""Where nodes and topics stand in the picture: data flows from left to right, and what stands somewhere stays there.

Nodes and topics take turns in columns: a topic is right of who publishes it, a node right of what it subscribes to
(longest paths, without the lines that close a cycle). Within a column the order follows the neighbours' heights; a
line that passes columns keeps room for itself there.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

COLUMN = 180.0
"""Pixels from one column to the next."""
ROW = 52.0
"""Pixels from one item of a column to the next."""
PASSAGE = 24.0
"""Pixels that a line has for itself in a column that it passes."""
MARGIN = 12.0
_SWEEPS = 6
_MOST_NEW = 0.34
"""Share of new items up to which everything else keeps its place."""

Place = tuple[float, float]


class Places:
    """Remembers where everything stands.

    Attributes:
        version: how often something was placed anew.
        width: of the picture.
        height: of the picture.
        ways: through which points lines go that pass columns.
    """

    def __init__(self) -> None:
        self.version = 0
        self.width = self.height = 0.0
        self.ways: dict[tuple[str, str], tuple[Place, ...]] = {}
        self._places: dict[str, Place] = {}
        self._known: tuple[frozenset[str], frozenset[tuple[str, str]]] = (frozenset(), frozenset())

    def of(self, items: Mapping[str, int], links: Iterable[tuple[str, str]]) -> Mapping[str, Place]:
        """Return the middle of each item.

        Args:
            items: each with the column it may not be left of: 0 of nodes and 1 of topics.
            links: from which item to which.
        """
        lines = frozenset(link for link in links if link[0] in items and link[1] in items and link[0] != link[1])
        known = (frozenset(items), lines)
        if known == self._known:
            return self._places
        self._known = known
        new = [item for item in items if item not in self._places]
        if len(new) <= _MOST_NEW * len(items):
            self._places = {item: place for item, place in self._places.items() if item in items}
            self.ways = {link: way for link, way in self.ways.items() if link in lines}
            self._add(sorted(new), items, lines)
        else:
            self._place_all(items, lines)
        self.width = max((x for x, _ in self._places.values()), default=0.0) + COLUMN / 2 + MARGIN
        self.height = max((y for _, y in self._places.values()), default=0.0) + ROW / 2 + MARGIN
        self.version += 1
        return self._places

    def _place_all(self, items: Mapping[str, int], links: Iterable[tuple[str, str]]) -> None:
        forward = _without_cycles(sorted(items), sorted(links))
        numbers = _columns(items, forward)
        columns: dict[int, list[str]] = {}
        for item in sorted(items):
            columns.setdefault(numbers[item], []).append(item)
        passages: dict[tuple[str, str], list[str]] = {}
        hops: list[tuple[str, str]] = []
        for link in forward:
            passages[link] = [f"\0{link[0]}\0{link[1]}\0{at}" for at in range(numbers[link[0]] + 1, numbers[link[1]])]
            for at, passage in enumerate(passages[link], numbers[link[0]] + 1):
                columns.setdefault(at, []).append(passage)
            way = [link[0], *passages[link], link[1]]
            hops += pairwise(way)
        ordered = [columns[number] for number in sorted(columns)]
        heights = _heights(ordered, _neighbours(hops), items)
        top = min(heights.values(), default=0.0)
        places = {
            item: (MARGIN + COLUMN / 2 + COLUMN * place, round(heights[item] - top + MARGIN + ROW / 2, 1))
            for place, column in enumerate(ordered)
            for item in column
        }
        self._places = {item: places[item] for item in items}
        self.ways = {link: tuple(places[one] for one in way) for link, way in passages.items() if way}

    def _add(self, new: Sequence[str], items: Mapping[str, int], links: Iterable[tuple[str, str]]) -> None:
        """Put new items into gaps: right of what leads to them, at the height of their neighbours."""
        before: dict[str, list[str]] = {}
        after: dict[str, list[str]] = {}
        for start, end in sorted(links):
            before.setdefault(end, []).append(start)
            after.setdefault(start, []).append(end)
        for item in sorted(new, key=lambda one: (items[one], one)):
            lefts = [self._places[one] for one in before.get(item, ()) if one in self._places]
            rights = [self._places[one] for one in after.get(item, ()) if one in self._places]
            first = MARGIN + COLUMN / 2 + COLUMN * items[item]
            if lefts:
                x = max(place[0] for place in lefts) + COLUMN
            else:
                x = max(first, min([place[0] for place in rights], default=first) - COLUMN)
            near = [place[1] for place in (*lefts, *rights)]
            wanted = sum(near) / len(near) if near else MARGIN + ROW / 2
            taken = sorted(y for at, y in self._places.values() if abs(at - x) < COLUMN / 2)
            self._places[item] = (x, _free(wanted, taken))


def _free(wanted: float, taken: Sequence[float]) -> float:
    least = MARGIN + ROW / 2
    candidates = [max(wanted, least), *(y + way * ROW for y in taken for way in (-1, 1))]
    free = [one for one in candidates if one >= least and all(abs(one - y) >= ROW - 0.5 for y in taken)]
    nearest = min(free, key=lambda one: (abs(one - wanted), one))
    return round(nearest, 1)


def _neighbours(links: Iterable[tuple[str, str]]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for start, end in links:
        found.setdefault(start, []).append(end)
        found.setdefault(end, []).append(start)
    return found


def _without_cycles(items: Sequence[str], links: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return the links but for those that lead back to where a walk came from, sources walked first."""
    after: dict[str, list[str]] = {}
    led_to = {end for _, end in links}
    for start, end in links:
        after.setdefault(start, []).append(end)
    kept: list[tuple[str, str]] = []
    done: set[str] = set()
    for first in sorted(items, key=lambda item: (item in led_to, item)):
        if first in done:
            continue
        open_: dict[str, None] = {first: None}
        path = [(first, iter(after.get(first, ())))]
        while path:
            item, ways = path[-1]
            way = next(ways, None)
            if way is None:
                path.pop()
                del open_[item]
                done.add(item)
            elif way not in open_:
                kept.append((item, way))
                if way not in done:
                    open_[way] = None
                    path.append((way, iter(after.get(way, ()))))
    return kept


def _columns(items: Mapping[str, int], links: Sequence[tuple[str, str]]) -> dict[str, int]:
    """Return the longest path to each item; what nothing leads to moves up to what it leads to."""
    before: dict[str, int] = dict.fromkeys(items, 0)
    after: dict[str, list[str]] = {}
    for start, end in links:
        before[end] += 1
        after.setdefault(start, []).append(end)
    columns = dict(items)
    sources = [item for item in sorted(items) if not before[item]]
    ready = list(sources)
    while ready:
        item = ready.pop()
        for one in after.get(item, ()):
            columns[one] = max(columns[one], columns[item] + 1)
            before[one] -= 1
            if not before[one]:
                ready.append(one)
    for item in sources:
        if item in after:
            columns[item] = max(columns[item], min(columns[one] for one in after[item]) - 1)
    return columns


def _heights(
    columns: list[list[str]], neighbours: Mapping[str, Sequence[str]], items: Mapping[str, int]
) -> dict[str, float]:
    """Return a height for each item and passage, those of a column apart; sorts the columns."""
    heights = {item: ROW * (place - (len(column) - 1) / 2) for column in columns for place, item in enumerate(column)}
    for sweep in range(_SWEEPS):
        for column in columns if sweep % 2 == 0 else reversed(columns):
            wanted = {}
            for item in column:
                near = [heights[one] for one in neighbours.get(item, ())]
                wanted[item] = sum(near) / len(near) if near else heights[item]
            column.sort(key=lambda item: (wanted[item], item))
            rooms = [ROW if item in items else PASSAGE for item in column]
            heights.update(zip(column, _spread([wanted[item] for item in column], rooms), strict=True))
    return heights


def _spread(wanted: Sequence[float], rooms: Sequence[float]) -> list[float]:
    """Return heights as close to the wanted ones as order and rooms allow: those that collide share what is off.

    The pool-adjacent-violators algorithm (Ayer et al., 1955) on what is wanted less the room of those before.
    """
    offsets, at = [], 0.0
    for place, room in enumerate(rooms):
        at += (room + rooms[place - 1]) / 2 if place else 0.0
        offsets.append(at)
    blocks: list[tuple[float, int]] = []
    for want, offset in zip(wanted, offsets, strict=True):
        blocks.append((want - offset, 1))
        while len(blocks) > 1 and blocks[-2][0] / blocks[-2][1] > blocks[-1][0] / blocks[-1][1]:
            total, count = blocks.pop()
            blocks[-1] = (blocks[-1][0] + total, blocks[-1][1] + count)
    shared = [total / count for total, count in blocks for _ in range(count)]
    return [share + offset for share, offset in zip(shared, offsets, strict=True)]
