"""A trend as lines: the whole and each package with its curve, then what happened."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import datetime, timezone

from roslens.model.trend import Trend, TrendPoint
from roslens.report.writing.terminal import Terminal, left, right

_BARS = "▁▂▃▄▅▆▇█"
_ASCII_BARS = "_.-=+*#@"
_MOST_EVENTS = 12
_WHOLE = {
    "sum": "all packages",
    "median": "median package",
    "repository": "repository",
    "repository_sum": "all repositories",
    "repository_median": "median repository",
}


def trend_text(trend: Trend, terminal: Terminal, *, decimals: int, most: int = 20) -> str:
    """Return the lines.

    Args:
        trend: with at least one point.
        terminal: that shows it.
        decimals: digits of values.
        most: so many packages are shown, those that changed most.
    """
    return "\n".join(_lines(trend, terminal, decimals, most)) + "\n"


def _lines(trend: Trend, terminal: Terminal, decimals: int, most: int) -> Iterator[str]:
    first, last = trend.points[0], trend.points[-1]
    unit = f" ({trend.unit})" if trend.unit else ""
    yield f"{trend.title}{unit}: {len(trend.points)} revisions, {_named(first)} to {_named(last)}"
    yield ""
    rows = [(_WHOLE[trend.whole_is], trend.whole)] if any(one is not None for one in trend.whole) else []
    repositories = {f"{name}/": values for name, values in trend.repositories.items()}
    packages = sorted(
        {**repositories, **trend.packages}.items(), key=lambda item: (-abs(_change(item[1]) or 0), item[0])
    )
    yield from _rows([*rows, *packages[:most]], terminal, decimals)
    if len(packages) > most:
        yield f"  {len(packages) - most} packages that changed less: --format csv has all"
    if trend.events:
        yield ""
        yield from _events(trend, terminal)


def _rows(rows: Sequence[tuple[str, Sequence[float | None]]], terminal: Terminal, decimals: int) -> Iterator[str]:
    """Yield a line for each row of which a value is known: name, bars, first and last value, change."""
    names = min(max((len(name) for name, _ in rows), default=0), 40)
    points = max((len(values) for _, values in rows), default=0)
    room = max(8, min(points, terminal.width - names - 40))
    for name, values in rows:
        known = [one for one in values if one is not None]
        if known:
            change = _change(values) or 0
            signed = f"{change:+,.{decimals}f}" if change else "="
            cells = (right(f"{one:,.{decimals}f}", 10) for one in (known[0], known[-1]))
            yield (
                f"  {left(terminal.cut(terminal.clean(name), names), names)} "
                f"{sparkbars(values, room, unicode=terminal.unicode)} {' '.join(cells)} {right(signed, 10)}"
            )


def _events(trend: Trend, terminal: Terminal) -> Iterator[str]:
    for event in trend.events[-_MOST_EVENTS:]:
        point = trend.points[event.point]
        warned = "" if event.kind in ("release", "moved") else "  (a step here may not come from the source)"
        yield f"  {date_of(point)}  {event.kind:<8}  {terminal.clean(event.text)}{warned}"
    if len(trend.events) > _MOST_EVENTS:
        yield f"  {len(trend.events) - _MOST_EVENTS} earlier events: --format json has all"


def sparkbars(values: Sequence[float | None], width: int, *, unicode: bool) -> str:
    """Return one bar a value, the last of each stretch where there are more than fit; a gap where there is none."""
    bars = _BARS if unicode else _ASCII_BARS
    if len(values) > width:
        values = [values[(place + 1) * len(values) // width - 1] for place in range(width)]
    known = [one for one in values if one is not None]
    if not known:
        return " " * len(values)
    least, span = min(known), max(known) - min(known)

    def bar(value: float | None) -> str:
        if value is None:
            return " "
        return bars[round((value - least) / span * (len(bars) - 1))] if span else bars[len(bars) // 2]

    return "".join(map(bar, values))


def date_of(point: TrendPoint) -> str:
    """Return the day of a point, in UTC."""
    return datetime.fromtimestamp(point.time_s, tz=timezone.utc).strftime("%Y-%m-%d")


def _named(point: TrendPoint) -> str:
    day = date_of(point)
    return point.name if point.name.startswith(day) else f"{point.name} ({day})"


def _change(values: Sequence[float | None]) -> float | None:
    known = [one for one in values if one is not None]
    return known[-1] - known[0] if known else None
