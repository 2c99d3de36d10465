"""A new ground for a computation graph: columns by flow, a lane for each namespace, room for wires that pass.

The steps are those of Sugiyama, Tagawa and Toda (1981): columns (:mod:`~roslens.dashboard.plan.columns`), order within
them, heights. The larger the graph, the fewer the sweeps, and the shorter the wires for which room is kept: the work
grows as the number of elements and wires does, but for sorting.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from roslens.dashboard.layout.order import SWEEPS, Columns, route, untangle
from roslens.dashboard.layout.place import PASSES, spread
from roslens.dashboard.plan.ground import (
    BETWEEN,
    EDGE,
    GAP,
    HEAD,
    PAD,
    ROOM,
    WAY,
    Ground,
    Part,
    Reach,
    Stand,
    Wire,
    parts_of,
)

PER_WIRE = 0.55
PER_TRACK = 5.0
"""Room of a track between columns, on which all wires of an element rise and fall."""
WIDEST = 80.0
ASPECT = 1.6
LOOSEST = 22.0
"""So much more than usual may be between rows."""

_EFFORT = 30_000
"""Elements and wires that are looked at in all sweeps together."""
_FEW = 3
"""So many sweeps are made without counting what crosses."""
_MOST_WAYS = 3000
"""Places kept for wires that pass columns."""


def survey(parts: Sequence[Part], columns: Sequence[int], wires: Sequence[Wire]) -> Ground:
    """Return a ground for ``parts``, in the order that decides ties.

    Args:
        parts: what is to be drawn, each key once.
        columns: the number of the column of each, from 0 without a gap.
        wires: between them.
    """
    if not parts:
        return Ground()
    number = {part.key: place for place, part in enumerate(parts)}
    names = sorted({part.lane for part in parts}, key=parts_of)
    lane_number = {name: place for place, name in enumerate(names)}
    lanes = [lane_number[part.lane] for part in parts]
    members: list[list[int]] = [[] for _ in range(1 + max(columns))]
    for place, column in enumerate(columns):
        members[column].append(place)
    ends = sorted({_rightward(number[start], number[end], columns) for start, end in wires})
    ends = [pair for pair in ends if columns[pair[0]] != columns[pair[1]]]
    longest = _longest([columns[right] - columns[left] for right, left in ends])
    routed = [pair for pair in ends if columns[pair[0]] - columns[pair[1]] <= longest]
    grid = route(members, len(parts), routed)
    work = len(grid.left) + sum(map(len, grid.left))
    lane_of = _lanes_of(lanes, grid)
    sweeps = max(2, min(SWEEPS, _EFFORT // work))
    # Counting what crosses takes as long as a sweep, and two sweeps make every order better than none.
    order = untangle(grid, sweeps, lanes=lane_of, counted=sweeps > _FEW)
    heights = [part.height + ROOM for part in parts] + [WAY] * (len(grid.left) - len(parts))
    passes = max(4, min(PASSES, 2 * _EFFORT // work))
    middles, reaches = _stack(order, heights, lane_of, grid, names, passes)
    spans, right = _spans(parts, grid, reaches[-1].bottom * ASPECT)
    more = _looser(right / ASPECT - reaches[-1].bottom, order, len(parts), lane_of)
    if more:
        heights[: len(parts)] = [height + more for height in heights[: len(parts)]]
        middles, reaches = _stack(order, heights, lane_of, grid, names, passes)
    stands = {
        part.key: Stand(
            round(sum(spans[columns[place]]) / 2, 1), middles[place], part.width, part.height, columns[place], part.lane
        )
        for place, part in enumerate(parts)
    }
    ways = {
        (parts[start].key, parts[end].key): tuple(middles[item] for item in way[1:-1])
        for way in grid.ways
        if len(way) > 2
        for start, end in ((way[0], way[-1]), (way[-1], way[0]))
    }
    return Ground(tuple(spans), stands, ways, tuple(reaches))


def _rightward(start: int, end: int, columns: Sequence[int]) -> tuple[int, int]:
    """Return the ends as right and left one."""
    return (start, end) if columns[start] > columns[end] else (end, start)


def _longest(lengths: Sequence[int]) -> int:
    """Return how many columns a wire may span for which room is kept, so that all of them together are not too many."""
    count = Counter(lengths)
    total = 0
    for length in sorted(count):
        total += count[length] * (length - 1)
        if total > _MOST_WAYS:
            return length - 1
    return max(count, default=0)


def _looser(room: float, order: Sequence[Sequence[int]], count: int, lane_of: Sequence[int]) -> float:
    """Return how much further apart rows stand, so that a wide picture fills ``room`` and names fit between them."""
    most: dict[int, int] = {}
    for column in order:
        for lane, rows in Counter(lane_of[item] for item in column if item < count).items():
            most[lane] = max(most.get(lane, 0), rows)
    return round(max(0.0, min(LOOSEST, room / max(1, sum(most.values())))), 1)


def _lanes_of(lanes: Sequence[int], grid: Columns) -> list[int]:
    """Return the lane of each item; a way stays in the upper lane of its ends until the last column."""
    found = [*lanes] + [0] * (len(grid.left) - len(lanes))
    for way in grid.ways:
        upper = min(lanes[way[0]], lanes[way[-1]])
        for item in way[1:-1]:
            found[item] = max(found[item], upper)
    return found


def _stack(
    order: Sequence[Sequence[int]],
    heights: Sequence[float],
    lane_of: Sequence[int],
    grid: Columns,
    names: Sequence[str],
    passes: int,
) -> tuple[list[float], list[Reach]]:
    """Return the middle of each item and from where to where each lane reaches: lanes below each other."""
    inside: list[list[list[int]]] = [[] for _ in names]
    for column in order:
        by_lane: dict[int, list[int]] = {}
        for item in column:
            by_lane.setdefault(lane_of[item], []).append(item)
        for lane, members in by_lane.items():
            inside[lane].append(members)
    left, right = (
        [[other for other in near if lane_of[other] == lane_of[item]] for item, near in enumerate(side)]
        for side in (grid.left, grid.right)
    )
    # Lanes know nothing of each other, so that all of them can be spread at once.
    centres = spread([column for lane in inside for column in lane], heights, left, right, passes)
    middles = [0.0] * len(heights)
    reaches: list[Reach] = []
    top = EDGE
    before: tuple[str, ...] = ()
    for name, columns in zip(names, inside, strict=True):
        above = min(centres[column[0]] - heights[column[0]] / 2 for column in columns)
        below = max(centres[column[-1]] + heights[column[-1]] / 2 for column in columns)
        opened, closed = nesting(before, name)
        top += closed * PAD + (BETWEEN if reaches else 0.0) + opened * HEAD
        for column in columns:
            for item in column:
                middles[item] = round(centres[item] - above + top, 1)
        reaches.append(Reach(name, round(top, 1), round(top + below - above, 1)))
        top += below - above
        before = parts_of(name)
    return middles, reaches


def nesting(before: tuple[str, ...], name: str) -> tuple[int, int]:
    """Return how many boxes begin and how many end between two lanes."""
    after = parts_of(name)
    same = next((place for place, pair in enumerate(zip(before, after, strict=False)) if pair[0] != pair[1]), None)
    common = min(len(before), len(after)) if same is None else same
    return len(after) - common, len(before) - common


def _spans(parts: Sequence[Part], grid: Columns, wanted: float) -> tuple[list[tuple[float, float]], float]:
    """Return from where to where each column reaches: the more wires between two, the wider apart they stand.

    The columns of a tall picture stand further apart, up to the width ``wanted``, so that it fills a screen.
    """
    spans: list[tuple[float, float]] = []
    left = EDGE + PAD
    for column in grid.columns:
        width = max((parts[item].width for item in column if item < len(parts)), default=0.0)
        spans.append((left, left + width))
        between = sum(len(grid.right[item]) for item in column)
        tracks = sum(bool(grid.right[item]) for item in column)
        left += width + GAP + min(WIDEST, max(PER_WIRE * between, PER_TRACK * tracks))
    right = spans[-1][1] + PAD
    more = min(2 * GAP, max(0.0, (wanted - right) / max(1, len(spans) - 1)))
    moved = [(round(start + place * more, 1), round(end + place * more, 1)) for place, (start, end) in enumerate(spans)]
    return moved, right + more * (len(spans) - 1)
