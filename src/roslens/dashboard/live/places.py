"""Where nodes and topics stand in the picture: data flows from left to right, and what stands somewhere stays there.

Nodes and topics take turns in columns: a topic is right of who publishes it, a node right of what it subscribes to
(longest paths, without the lines that close a cycle). Within a column the order follows the neighbours' heights.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

COLUMN = 196.0
"""Pixels from one column to the next."""
ROW = 52.0
"""Pixels from one item of a column to the next."""
MARGIN = 40.0
_SWEEPS = 6
_MOST_NEW = 0.34
"""Share of new items up to which everything else keeps its place."""

Place = tuple[float, float]


class Places:
    """Remembers where everything stands; ``version`` counts how often something was placed anew."""

    def __init__(self) -> None:
        self.version = 0
        self.width = self.height = 0.0
        self._places: dict[str, Place] = {}
        self._columns: dict[str, int] = {}
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
            self._add(sorted(new), items, lines)
        else:
            self._place_all(items, lines)
        self.width = max((x for x, _ in self._places.values()), default=0.0) + COLUMN / 2 + MARGIN
        self.height = max((y for _, y in self._places.values()), default=0.0) + ROW / 2 + MARGIN
        self.version += 1
        return self._places

    def _place_all(self, items: Mapping[str, int], links: Iterable[tuple[str, str]]) -> None:
        forward = _without_cycles(sorted(items), sorted(links))
        self._columns = _columns(items, forward)
        columns: dict[int, list[str]] = {}
        for item in sorted(items):
            columns.setdefault(self._columns[item], []).append(item)
        ordered = [columns[number] for number in sorted(columns)]
        heights = _heights(ordered, _neighbours(forward))
        top = min(heights.values(), default=0.0)
        self._places = {
            item: (MARGIN + COLUMN / 2 + COLUMN * place, round(heights[item] - top + MARGIN + ROW / 2, 1))
            for place, column in enumerate(ordered)
            for item in column
        }

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


def _heights(columns: list[list[str]], neighbours: Mapping[str, Sequence[str]]) -> dict[str, float]:
    """Return a height for each item, those of a column at least a row apart; sorts the columns."""
    heights = {item: ROW * (place - (len(column) - 1) / 2) for column in columns for place, item in enumerate(column)}
    for sweep in range(_SWEEPS):
        for column in columns if sweep % 2 == 0 else reversed(columns):
            wanted = {}
            for item in column:
                near = [heights[one] for one in neighbours.get(item, ())]
                wanted[item] = sum(near) / len(near) if near else heights[item]
            column.sort(key=lambda item: (wanted[item], item))
            _spread(column, wanted, heights)
    return heights


def _spread(column: Sequence[str], wanted: Mapping[str, float], heights: dict[str, float]) -> None:
    """Give each its wanted height as far as the others of the column leave room, in blocks that share what is off."""
    blocks: list[tuple[float, int]] = []  # sum of (wanted - offset in the block), and how many
    for item in column:
        blocks.append((wanted[item], 1))
        while len(blocks) > 1:
            (sum1, count1), (sum2, count2) = blocks[-2], blocks[-1]
            if sum2 / count2 >= sum1 / count1 + ROW * count1:
                break
            blocks[-2:] = [(sum1 + sum2 - ROW * count1 * count2, count1 + count2)]
    at = 0
    for total, count in blocks:
        for place in range(count):
            heights[column[at + place]] = total / count + ROW * place
        at += count
