"""In which order the nodes of each column stand, so that few edges cross.

Edges that span several columns get a way-point in each column between, so that they pass between nodes rather than
through them. Long edges of one end, whichever of the two has more of them, share their way-points: twenty packages
that one needs make one line to it, not twenty beside each other. Orders are improved by the barycentre heuristic
(Sugiyama, Tagawa, Toda 1981) in sweeps to and fro; the order with the fewest crossings wins.
"""

from __future__ import annotations

from bisect import bisect_left, insort
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import msgspec

SWEEPS = 12


class Columns(msgspec.Struct, frozen=True):
    """Nodes and way-points in columns. Items below ``nodes`` are nodes, the others way-points.

    ``left`` and ``right`` are the neighbours of an item in the columns beside it; ``ways`` gives for each routed edge
    its items from the left end to the right end.
    """

    nodes: int
    columns: list[list[int]]
    left: list[list[int]]
    right: list[list[int]]
    ways: list[list[int]]


def route(columns: Sequence[Sequence[int]], count: int, edges: Sequence[tuple[int, int]]) -> Columns:
    """Place nodes and way-points. Each edge (a, b) goes from a on the right to b on the left."""
    place = [0] * count
    for number, column in enumerate(columns):
        for node in column:
            place[node] = number
    filled = [list(column) for column in columns]
    left: list[list[int]] = [[] for _ in range(count)]
    right: list[list[int]] = [[] for _ in range(count)]
    trunks = _trunks(place, edges)
    shared: dict[tuple[tuple[int, bool], int], int] = {}
    linked: set[tuple[int, int]] = set()
    ways = []
    for dependent, needed in edges:
        way = [needed]
        for number in range(place[needed] + 1, place[dependent]):
            key = (trunks[dependent, needed], number)
            if key not in shared:
                shared[key] = len(left)
                left.append([])
                right.append([])
                filled[number].append(shared[key])
            way.append(shared[key])
        way.append(dependent)
        for first, second in pairwise(way):
            if (first, second) not in linked:
                linked.add((first, second))
                right[first].append(second)
                left[second].append(first)
        ways.append(way)
    return Columns(count, filled, left, right, ways)


def _trunks(place: Sequence[int], edges: Sequence[tuple[int, int]]) -> dict[tuple[int, int], tuple[int, bool]]:
    """Return for each long edge the end whose way-points it shares, and whether that is the dependent."""
    long = [(dependent, needed) for dependent, needed in edges if place[dependent] - place[needed] > 1]
    of_dependent = Counter(dependent for dependent, _ in long)
    of_needed = Counter(needed for _, needed in long)
    return {
        (dependent, needed): (dependent, True) if of_dependent[dependent] >= of_needed[needed] else (needed, False)
        for dependent, needed in long
    }


def untangle(
    columns: Columns, sweeps: int = SWEEPS, lanes: Sequence[int] = (), *, counted: bool = True
) -> list[list[int]]:
    """Return the columns reordered so that few edges cross.

    Args:
        columns: to reorder.
        sweeps: how often all of them are gone through.
        lanes: a number for each item, where those of a lower one stay above those of a higher one.
        counted: whether crossings are counted after each sweep and the best order is taken; the last one otherwise.
    """
    order = [sorted(column, key=lanes.__getitem__) if lanes else list(column) for column in columns.columns]
    best, fewest = [list(column) for column in order], _crossings(order, columns) if counted else 1
    for sweep in range(sweeps):
        if fewest == 0:
            break
        _sweep(order, columns, lanes, forward=sweep % 2 == 0)
        crossings = _crossings(order, columns) if counted else fewest
        if crossings < fewest:
            best, fewest = [list(column) for column in order], crossings
    return best if counted else order


def _sweep(order: list[list[int]], columns: Columns, lanes: Sequence[int], *, forward: bool) -> None:
    """Order each column by the one beside it, from the left or from the right."""
    if forward:
        for number in range(1, len(order)):
            order[number] = _by_barycentre(order[number], order[number - 1], columns.left, lanes)
    else:
        for number in range(len(order) - 2, -1, -1):
            order[number] = _by_barycentre(order[number], order[number + 1], columns.right, lanes)


def _by_barycentre(
    column: Sequence[int], beside: Sequence[int], neighbours: Sequence[Sequence[int]], lanes: Sequence[int]
) -> list[int]:
    position = {item: place for place, item in enumerate(beside)}
    scale = len(beside) / max(1, len(column))

    def centre(entry: tuple[int, int]) -> tuple[int, float, int]:
        place, item = entry
        places = [position[other] for other in neighbours[item]]
        # An item without neighbours keeps its relative height.
        return (lanes[item] if lanes else 0, sum(places) / len(places) if places else place * scale, place)

    return [item for _, item in sorted(enumerate(column), key=centre)]


def _crossings(order: Sequence[Sequence[int]], columns: Columns) -> int:
    total = 0
    for number in range(len(order) - 1):
        position = {item: place for place, item in enumerate(order[number + 1])}
        seen: list[int] = []
        for item in order[number]:
            places = sorted(position[other] for other in columns.right[item] if other in position)
            for place in places:
                # Edges that started higher and end lower cross this one.
                total += len(seen) - bisect_left(seen, place + 1)
            for place in places:
                insort(seen, place)
    return total
