"""How high each item of a column stands: as near to its neighbours as the room allows, in the given order."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

PASSES = 16


def spread(
    order: Sequence[Sequence[int]],
    heights: Sequence[float],
    left: Sequence[Sequence[int]],
    right: Sequence[Sequence[int]],
    passes: int = PASSES,
) -> list[float]:
    """Return the vertical centre of each item.

    Args:
        order: items of each column from top to bottom.
        heights: the room that each item needs.
        left: neighbours of each item in the column before.
        right: neighbours in the column after.
        passes: how often each column is gone through.
    """
    centre = _stacked(order, heights)
    offsets = [_offsets([heights[item] for item in column]) for column in order]
    steps = list(zip(order, offsets, strict=True))
    for turn in range(passes):
        last = turn >= passes - 2
        forward = turn % 2 == 0
        beside = left if forward else right
        for column, offset in steps if forward else reversed(steps):
            wanted = [_wish(centre, item, (*left[item], *right[item]) if last else beside[item]) for item in column]
            for item, place in zip(column, _pooled(wanted, offset), strict=True):
                centre[item] = place
    return centre


def _stacked(order: Sequence[Sequence[int]], heights: Sequence[float]) -> list[float]:
    """Return the centre of each item where the columns have no room between items."""
    centre = [0.0] * len(heights)
    for column in order:
        top = -sum(heights[item] for item in column) / 2
        for item in column:
            centre[item] = top + heights[item] / 2
            top += heights[item]
    return centre


def _wish(centre: Sequence[float], item: int, neighbours: Sequence[int]) -> float:
    if not neighbours:
        return centre[item]
    return sum([centre[other] for other in neighbours]) / len(neighbours)


def settle(wanted: Sequence[float], heights: Sequence[float]) -> list[float]:
    """Return places in the given order, without overlap, with the least sum of squared distances to ``wanted``.

    This is isotonic regression on the wishes less the room above, by pooling adjacent violators (Barlow et al. 1972).
    """
    return _pooled(wanted, _offsets(heights))


def _offsets(heights: Sequence[float]) -> list[float]:
    """Return the centre of each where they stand on each other without room between."""
    return [below - height / 2 for below, height in zip(accumulate(heights), heights, strict=True)]


def _pooled(wanted: Sequence[float], offsets: Sequence[float]) -> list[float]:
    blocks: list[tuple[float, int]] = []
    for wish, offset in zip(wanted, offsets, strict=True):
        mean, size = wish - offset, 1
        while blocks and blocks[-1][0] > mean:
            other, count = blocks.pop()
            mean = (mean * size + other * count) / (size + count)
            size += count
        blocks.append((mean, size))
    levels = [mean for mean, size in blocks for _ in range(size)]
    return [level + offset for level, offset in zip(levels, offsets, strict=True)]
