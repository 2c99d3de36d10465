"""Curves over time: where lines, ticks and marks of revisions stand in a plot of a fixed size."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import accumulate

import msgspec

from roslens.dashboard.charts.dates import dates_between, day_of
from roslens.dashboard.charts.figures import number
from roslens.model.trend import TrendEvent, TrendPoint

WIDTH = 860.0
HEIGHT = 220.0
MOST_LETTERS = 24
MOST_LINES = 16
DAY_WIDTH = 92.0
"""Of a date below the smallest plots, where letters are largest, with the room between two dates."""
MOST_POINTS = 400
"""More points than this are thinned out evenly: a screen shows no more of them."""


class Line(msgspec.Struct, frozen=True):
    """A curve: its parts between gaps, x, y and text of each point, and its last value; ``style`` counts from 0."""

    name: str
    style: int
    paths: tuple[str, ...]
    places: tuple[tuple[float, float, str], ...]
    last: str


class Mark(msgspec.Struct, frozen=True):
    """An event: where, of which kind, what, whether its text is shown, and whether that ends there, not begins."""

    x: float
    kind: str
    text: str
    labelled: bool
    left: bool


class LineChart(msgspec.Struct, frozen=True):
    """A plot: lines, ticks of both axes and marks of events, in units of :data:`WIDTH` and :data:`HEIGHT`.

    ``places`` are those of all revisions along the axis.
    """

    lines: tuple[Line, ...]
    across: tuple[tuple[float, str], ...]
    up: tuple[tuple[float, str], ...]
    marks: tuple[Mark, ...]
    places: tuple[float, ...] = ()

    @property
    def dense(self) -> bool:
        """Whether releases are so many that lines through the plot would hide the curves."""
        return len(self.marks) > MOST_LINES


def line_chart(
    points: Sequence[TrendPoint],
    columns: Iterable[tuple[str, Sequence[float | None]]],
    events: Sequence[TrendEvent],
    digits: int,
) -> LineChart | None:
    """Return the plot; None where no column has a value.

    Revisions stand where their time is, so that a slope tells how fast something changed; none stands before the one
    that it follows, even if a clock was wrong. Those of a single instant stand at equal distances.

    Args:
        points: the revisions.
        columns: name and values of each curve, a value for each revision.
        events: what happened at them.
        digits: behind the point of values.
    """
    held = [(name, values) for name, values in columns if any(one is not None for one in values)]
    known = [one for _, values in held for one in values if one is not None]
    if not known:
        return None
    low, high, ticks = _ticks(min(known), max(known), whole=all(one == int(one) for one in known))
    places = _places([one.time_s for one in points])
    x = places.__getitem__

    def y(value: float) -> float:
        return round(HEIGHT * (1 - (value - low) / (high - low)), 1)

    shown = _thinned(len(points), {one.point for one in events})
    lines = tuple(
        _line(name, style, values, points, shown, (x, y), digits) for style, (name, values) in enumerate(held)
    )
    return LineChart(
        tuple(lines),
        _across(points, x),
        tuple((y(tick), _tick_text(tick, ticks)) for tick in ticks),
        _marks(events, x),
        places,
    )


def _places(times: Sequence[float]) -> tuple[float, ...]:
    if len(times) == 1:
        return (WIDTH / 2,)
    ordered = list(accumulate(times, max))
    span = ordered[-1] - ordered[0]
    if not span:
        return tuple(round(WIDTH * place / (len(times) - 1), 1) for place in range(len(times)))
    return tuple(round(WIDTH * (one - ordered[0]) / span, 1) for one in ordered)


def _line(
    name: str,
    style: int,
    values: Sequence[float | None],
    points: Sequence[TrendPoint],
    shown: Sequence[int],
    at: tuple[Callable[[int], float], Callable[[float], float]],
    digits: int,
) -> Line:
    x, y = at
    paths: list[list[str]] = [[]]
    places = []
    for place in shown:
        value = values[place]
        if value is None:
            paths.append([])
            continue
        paths[-1].append(f"{x(place)},{y(value)}")
        places.append((x(place), y(value), f"{points[place].name}, {day(points[place])}: {number(value, digits)}"))
    last = next((number(value, digits) for value in reversed(values) if value is not None), "")
    return Line(name, style, tuple("M" + " L".join(part) for part in paths if part), tuple(places), last)


def _thinned(count: int, kept: set[int]) -> list[int]:
    if count <= MOST_POINTS:
        return list(range(count))
    even = {round(place * (count - 1) / (MOST_POINTS - 1)) for place in range(MOST_POINTS)}
    return sorted(even | kept)


def _ticks(least: float, most: float, *, whole: bool = False) -> tuple[float, float, list[float]]:
    """Return the ends of the axis and three to six ticks; amounts begin at 0 unless they all are far from it.

    Between whole numbers, as those of what is counted, there are no ticks.
    """
    low = 0.0 if least >= 0 and least < 0.7 * most else least
    if most <= low:
        low, most = (low - 1, low + 1) if low else (0.0, 1.0)
    raw = (most - low) / 4
    power = 10.0 ** math.floor(math.log10(raw))
    width = next(step * power for step in (1, 2, 5, 10) if step * power >= raw * 0.999)
    width = max(width, 1.0) if whole else width
    first, last = math.floor(low / width), math.ceil(most / width)
    return first * width, last * width, [place * width for place in range(first, last + 1)]


def _tick_text(tick: float, ticks: Sequence[float]) -> str:
    """Return what a line across the plot stands for; beside it there is room for six letters."""
    for size, sign, least in ((1e6, " M", 2e6), (1e3, " k", 1e4)):
        if ticks[-1] >= least:
            scaled = [one / size for one in ticks]
            return f"{number(tick / size, _digits_of(scaled))}{sign}" if tick else "0"
    return number(tick, _digits_of(ticks))


def _digits_of(ticks: Sequence[float]) -> int:
    return next((digits for digits in range(6) if all(abs(one - round(one, digits)) < 1e-9 for one in ticks)), 6)


def _across(points: Sequence[TrendPoint], x: Callable[[int], float]) -> tuple[tuple[float, str], ...]:
    """Return the first and the last day, and round dates between, as many as do not stand on one another."""
    first, last = points[0].time_s, max(one.time_s for one in points)
    if len(points) == 1:
        return ((x(0), day(points[0])),)
    if last <= first:
        return ((0.0, day_of(first)), (WIDTH, day_of(last)))
    between = []
    for time, text in dates_between(first, last, most=int(WIDTH / DAY_WIDTH)):
        place = round(WIDTH * (time - first) / (last - first), 1)
        # The dates between are centred, those at the ends stand inside the plot.
        apart = DAY_WIDTH * (1 + len(text) / (2 * len("2026-01-31")))
        if apart <= place <= WIDTH - apart:
            between.append((place, text))
    return ((0.0, day_of(first)), *between, (WIDTH, day_of(last)))


def _marks(events: Sequence[TrendEvent], x: Callable[[int], float]) -> tuple[Mark, ...]:
    """Return marks; those whose text would stand on another's are not labelled."""
    marks: list[Mark] = []
    free = -1.0
    for event in events:
        place = x(event.point)
        room = 6.4 * len(event.text) + 8
        left = place + room > WIDTH + 12
        begin = place - room if left else place
        labelled = begin >= free and len(event.text) <= MOST_LETTERS
        if labelled:
            free = begin + room
        marks.append(Mark(place, event.kind, event.text, labelled, left))
    return tuple(marks)


def day(point: TrendPoint) -> str:
    """Return the day of a revision, in UTC."""
    return day_of(point.time_s)
