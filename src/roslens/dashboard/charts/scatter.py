"""Files by how much they change and how complex they are: places in a plot with logarithmic axes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import msgspec

from roslens.dashboard.charts.figures import number

WIDTH = 860.0
HEIGHT = 360.0
LABELLED = 6
"""The names of so many dots stand beside them, as far as there is room."""


class Dot(msgspec.Struct, frozen=True):
    """A file: where it stands, how large, its name and its text; ``label`` is empty where there is no room for it."""

    x: float
    y: float
    radius: float
    key: str
    text: str
    label: str
    left: bool


class Scatter(msgspec.Struct, frozen=True):
    """Dots, the most telling first, and ticks of both axes."""

    dots: tuple[Dot, ...]
    across: tuple[tuple[float, str], ...]
    up: tuple[tuple[float, str], ...]


def scatter_of(rows: Sequence[tuple[str, str, float, float, float]]) -> Scatter | None:
    """Return the plot; None without rows.

    Args:
        rows: key, text, value across, value up and weight of each, the most telling first; values are at least 0.
    """
    if not rows:
        return None
    across, up = _decades(row[2] for row in rows), _decades(row[3] for row in rows)
    most = max((row[4] for row in rows), default=0) or 1
    taken: list[tuple[float, float, float]] = []
    dots = []
    for place, (key, text, right, high, weight) in enumerate(rows):
        x, y = round(WIDTH * _part(right, across), 1), round(HEIGHT * (1 - _part(high, up)), 1)
        name = key.rpartition("/")[2]
        room = 7.2 * len(name) + 10
        sides = [(left, x - room if left else x) for left in ((True, False) if x > WIDTH * 0.7 else (False, True))]
        clear = [side for side in sides if not any(abs(y - y2) < 15 and side[1] < end and begin < side[1] + room
                                                   for y2, begin, end in taken)]  # fmt: skip
        shown = place < 2 * LABELLED and len(taken) < LABELLED and bool(clear)
        left, begin = clear[0] if shown else sides[0]
        label = name if shown else ""
        if shown:
            taken.append((y, begin, begin + room))
        dots.append(Dot(x, y, round(3 + 7 * math.sqrt(weight / most), 1), key, text, label, left))
    return Scatter(
        tuple(dots),
        tuple((round(WIDTH * _part(tick, across), 1), number(tick)) for tick in _marks(across)),
        tuple((round(HEIGHT * (1 - _part(tick, up)), 1), number(tick)) for tick in _marks(up)),
    )


def _decades(values: Iterable[float]) -> tuple[int, int]:
    known = [max(1.0, value) for value in values]
    low, high = math.floor(math.log10(min(known))), math.ceil(math.log10(max(known)))
    return low, max(high, low + 1)


def _part(value: float, decades: tuple[int, int]) -> float:
    low, high = decades
    return (math.log10(max(1.0, value)) - low) / (high - low)


def _marks(decades: tuple[int, int]) -> list[float]:
    return [10.0**power for power in range(decades[0], decades[1] + 1)]
