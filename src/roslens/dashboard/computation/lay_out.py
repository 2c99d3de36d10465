"""Where the elements of a computation graph stand: columns by flow, a box for each namespace, wires around elements."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import msgspec

from roslens.dashboard.layout.order import Columns, route, untangle
from roslens.dashboard.layout.place import spread

GAP = 54.0
PER_WIRE = 0.55
WIDEST = 64.0
ROOM = 10.0
WAY = 8.0
PAD = 12.0
HEAD = 20.0
BETWEEN = 16.0
EDGE = 16.0
ASPECT = 1.6
LOOSEST = 22.0
"""So much more than usual may be between rows."""

TIP = 6.0
"""Length of the arrow at the end of a wire."""

TURN = 13.0
"""How far beside an element a wire that runs back turns round."""


class Item(msgspec.Struct, frozen=True):
    """What is to be placed: its size, the number of its lane and of its column."""

    width: float
    height: float
    lane: int
    column: int


class Box(msgspec.Struct, frozen=True):
    """The box of a namespace; ``depth`` is in how many others it stands."""

    name: str
    x: float
    y: float
    width: float
    height: float
    depth: int


class Picture(msgspec.Struct, frozen=True):
    """Where everything stands: middles of items, their row within lane and column, boxes, a path for each wire."""

    width: float
    height: float
    places: tuple[tuple[float, float], ...]
    rows: tuple[int, ...]
    boxes: tuple[Box, ...]
    paths: tuple[str, ...]


def lay_out(items: Sequence[Item], wires: Sequence[tuple[int, int]], lanes: Sequence[str]) -> Picture:
    """Place items.

    Args:
        items: in the order that decides ties.
        wires: from which item to which.
        lanes: names of the namespaces, sorted; an item's lane is a number into them.
    """
    count = 1 + max((item.column for item in items), default=-1)
    columns = [[place for place, item in enumerate(items) if item.column == number] for number in range(count)]
    routed = sorted({_rightward(items, wire) for wire in wires if items[wire[0]].column != items[wire[1]].column})
    grid = route(columns, len(items), routed)
    lane_of = _lanes_of(items, grid)
    order = untangle(grid, lanes=lane_of)
    heights = [item.height + ROOM for item in items] + [WAY] * (len(grid.left) - len(items))
    middles, spans_down = _stack(order, heights, lane_of, grid, lanes)
    spans, right = _spans(items, columns, grid, _bottom(spans_down) * ASPECT)
    more = _looser(right / ASPECT - _bottom(spans_down), order, len(items), lane_of)
    if more:
        heights[: len(items)] = [height + more for height in heights[: len(items)]]
        middles, spans_down = _stack(order, heights, lane_of, grid, lanes)
    places = [(round(sum(spans[item.column]) / 2, 1), middles[number]) for number, item in enumerate(items)]
    boxes = _boxes(items, lanes, spans, spans_down)
    rows = [0] * len(items)
    for column in order:
        for row, number in enumerate(column):
            if number < len(items):
                rows[number] = row
    ways = dict(zip(routed, grid.ways, strict=True))
    paths = tuple(_path(wire, ways, items, places, middles, spans) for wire in wires)
    bottom = max((box.y + box.height for box in boxes), default=0.0)
    bottom = max(bottom, max((y + items[number].height / 2 for number, (_, y) in enumerate(places)), default=0.0))
    return Picture(
        width=round(right + EDGE, 1),
        height=round(bottom + EDGE, 1),
        places=tuple(places),
        rows=tuple(rows),
        boxes=tuple(boxes),
        paths=paths,
    )


def _bottom(reach: dict[int, tuple[float, float]]) -> float:
    return max((end for lane in reach.values() for end in lane), default=0.0)


def _looser(room: float, order: Sequence[Sequence[int]], count: int, lane_of: Sequence[int]) -> float:
    """Return how much further apart rows stand, so that a wide picture fills ``room`` and names fit between them."""
    most: dict[int, int] = {}
    for column in order:
        for lane, rows in Counter(lane_of[item] for item in column if item < count).items():
            most[lane] = max(most.get(lane, 0), rows)
    return round(max(0.0, min(LOOSEST, room / max(1, sum(most.values())))), 1)


def _rightward(items: Sequence[Item], wire: tuple[int, int]) -> tuple[int, int]:
    """Return the wire as (right end, left end)."""
    return wire if items[wire[0]].column > items[wire[1]].column else (wire[1], wire[0])


def _lanes_of(items: Sequence[Item], grid: Columns) -> list[int]:
    """Return the lane of each item; way-points stay in the lane of their left end until the last column."""
    found = [item.lane for item in items] + [0] * (len(grid.left) - len(items))
    for way in grid.ways:
        for item in way[1:-1]:
            found[item] = max(found[item], min(items[way[0]].lane, items[way[-1]].lane))
    return found


def _stack(
    order: Sequence[Sequence[int]],
    heights: Sequence[float],
    lane_of: Sequence[int],
    grid: Columns,
    lanes: Sequence[str],
) -> tuple[list[float], dict[int, tuple[float, float]]]:
    """Return the middle of each item and from where to where each lane reaches: lanes below each other."""
    middles = [0.0] * len(heights)
    reach: dict[int, tuple[float, float]] = {}
    top = EDGE
    depth_before: tuple[str, ...] = ()
    for lane, name in enumerate(lanes):
        inside = [[item for item in column if lane_of[item] == lane] for column in order]
        members = [item for column in inside for item in column]
        if not members:
            continue
        left = [[other for other in grid.left[item] if lane_of[other] == lane] for item in range(len(heights))]
        right = [[other for other in grid.right[item] if lane_of[other] == lane] for item in range(len(heights))]
        centres = spread(inside, heights, left, right)
        above = min(centres[item] - heights[item] / 2 for item in members)
        below = max(centres[item] + heights[item] / 2 for item in members)
        opened, closed = _nesting(depth_before, name)
        top += closed * PAD + (BETWEEN if reach else 0.0) + opened * HEAD
        for item in members:
            middles[item] = round(centres[item] - above + top, 1)
        reach[lane] = (top, top + below - above)
        top += below - above
        depth_before = _parts(name)
    return middles, reach


def _parts(name: str) -> tuple[str, ...]:
    return tuple(part for part in name.split("/") if part)


def _nesting(before: tuple[str, ...], name: str) -> tuple[int, int]:
    """Return how many boxes begin and how many end between two lanes."""
    after = _parts(name)
    same = next((place for place, pair in enumerate(zip(before, after, strict=False)) if pair[0] != pair[1]), None)
    common = min(len(before), len(after)) if same is None else same
    return len(after) - common, len(before) - common


def _spans(
    items: Sequence[Item], columns: Sequence[Sequence[int]], grid: Columns, wanted: float
) -> tuple[list[tuple[float, float]], float]:
    """Return from where to where each column reaches: the more wires between two, the wider apart they stand.

    The columns of a tall picture stand further apart, up to the width ``wanted``, so that it fills a screen.
    """
    spans: list[tuple[float, float]] = []
    left = EDGE + PAD
    for number, column in enumerate(columns):
        width = max((items[item].width for item in column), default=0.0)
        spans.append((left, left + width))
        between = sum(len(grid.right[item]) for item in grid.columns[number])
        left += width + GAP + min(WIDEST, PER_WIRE * between)
    right = (spans[-1][1] if spans else 0.0) + PAD
    between = max(1, len(spans) - 1)
    more = min(2 * GAP, max(0.0, (wanted - right) / between))
    moved = [(start + place * more, end + place * more) for place, (start, end) in enumerate(spans)]
    return moved, right + more * (len(spans) - 1 if spans else 0)


def _boxes(
    items: Sequence[Item],
    lanes: Sequence[str],
    spans: Sequence[tuple[float, float]],
    reach: dict[int, tuple[float, float]],
) -> list[Box]:
    """Return a box around each namespace but the global one, outer ones first."""
    names = sorted(
        {
            "/" + "/".join(_parts(lanes[lane])[: depth + 1])
            for lane in reach
            for depth in range(len(_parts(lanes[lane])))
        }
    )
    deepest = max((len(_parts(name)) for name in names), default=0)
    found = []
    for name in names:
        members = [lane for lane in reach if lanes[lane] == name or lanes[lane].startswith(name + "/")]
        columns = [item.column for item in items if item.lane in members]
        if not columns:
            continue
        depth = len(_parts(name)) - 1
        # What stands inside of others is that much narrower, so that no two sides fall together.
        side = PAD * (deepest - depth) / deepest
        left, right = spans[min(columns)][0] - side, spans[max(columns)][1] + side
        first = min(members, key=lambda lane: reach[lane][0])
        last = max(members, key=lambda lane: reach[lane][1])
        top = reach[first][0] - HEAD * (len(_parts(lanes[first])) - depth)
        bottom = reach[last][1] + PAD / 2 * (len(_parts(lanes[last])) - depth)
        found.append(Box(name, round(left, 1), round(top, 1), round(right - left, 1), round(bottom - top, 1), depth))
    return found


def _path(
    wire: tuple[int, int],
    ways: dict[tuple[int, int], list[int]],
    items: Sequence[Item],
    places: Sequence[tuple[float, float]],
    middles: Sequence[float],
    spans: Sequence[tuple[float, float]],
) -> str:
    """Return a line that runs level through columns and bends between them, with an arrow where things flow to.

    It leaves at the right side of an element and enters at the left side of another; one that runs back to an earlier
    column turns round beside both of its ends.
    """
    source, target = wire
    ends = (_side(items, places, source), _side(items, places, target))
    if items[source].column == items[target].column:
        return _within(*ends)
    way = ways[_rightward(items, wire)]
    steps = [(spans[items[way[0]].column + step], middles[item]) for step, item in enumerate(way)]
    if target == way[0]:
        return _back(*ends, steps[::-1])
    x, y = places[source][0] + items[source].width / 2, places[source][1]
    parts = [f"M{x:.1f} {y:.1f}"]
    for (before, _), (after, height) in pairwise(steps):
        parts.append(_bend(before[1], y, after[0], height))
        y = height
    end = places[target][0] - items[target].width / 2
    return "".join((*parts, f"H{end:.1f}", arrow(end, y)))


class Side(msgspec.Struct, frozen=True):
    """An end of a wire: the middle of an element, half of its width and of its height."""

    x: float
    y: float
    across: float
    down: float


def _side(items: Sequence[Item], places: Sequence[tuple[float, float]], number: int) -> Side:
    return Side(*places[number], items[number].width / 2, items[number].height / 2)


def _bend(x: float, y: float, to: float, height: float) -> str:
    middle = (x + to) / 2
    return f"H{x:.1f}C{middle:.1f} {y:.1f} {middle:.1f} {height:.1f} {to:.1f} {height:.1f}"


def _back(source: Side, target: Side, steps: Sequence[tuple[tuple[float, float], float]]) -> str:
    """Return a line to an earlier column; ``steps`` are span and height at each column, both ends' included."""
    right = source.x + source.across
    y, end = _beyond(source, steps[1][1]), _beyond(target, steps[-2][1])
    parts = [f"M{right:.1f} {source.y:.1f}", _turn(right, source.y, y, 1)]
    x = steps[0][0][0]
    for (start, stop), height in steps[1:-1]:
        parts.append(_bend(x, y, stop, height))
        x, y = start, height
    return "".join((*parts, _bend(x, y, steps[-1][0][1], end), _entry(target, end)))


def _within(source: Side, target: Side) -> str:
    """Return a line to another element of the same column: it changes its row beside both, where nothing stands."""
    right, end = source.x + source.across, _beyond(target, source.y)
    far = max(right, target.x + target.across)
    out = far + TURN + min(30.0, abs(source.y - target.y) / 8)
    line = f"M{right:.1f} {source.y:.1f}H{far:.1f}C{out:.1f} {source.y:.1f} {out:.1f} {end:.1f} {far:.1f} {end:.1f}"
    return line + _entry(target, end)


def _beyond(one: Side, towards: float) -> float:
    """Return the height between the row of an element and the next one in a direction."""
    return one.y + math.copysign(one.down + ROOM / 2, towards - one.y)


def _turn(x: float, y: float, to: float, direction: int) -> str:
    out = x + direction * TURN
    return f"C{out:.1f} {y:.1f} {out:.1f} {to:.1f} {x:.1f} {to:.1f}"


def _entry(target: Side, y: float) -> str:
    """Return the end of a line that comes from the right: past the element, round, and into its left side."""
    left = target.x - target.across
    return f"H{left:.1f}{_turn(left, y, target.y, -1)}{arrow(left, target.y)}"


def arrow(x: float, y: float) -> str:
    """Return the tip of a wire that comes from the left."""
    back = x - TIP
    return f"M{back:.1f} {y - TIP / 2:.1f}L{x:.1f} {y:.1f}L{back:.1f} {y + TIP / 2:.1f}"
