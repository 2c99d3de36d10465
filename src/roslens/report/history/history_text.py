"""What was kept of a live system, on a terminal: each series as a line with a picture of it, then what went wrong."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime

from roslens.model.verdict import Verdict
from roslens.report.history.history_rows import Extract
from roslens.report.writing.terminal import Terminal, columns, left, right
from roslens.store.live.read_history import Kept
from roslens.store.live.series import Point

_BARS = "▁▂▃▄▅▆▇█"
_ASCII_BARS = "_.-=+*#@"
_GAP = " "
_MOST_FAULTS = 40
Amount = Callable[[float, str], str]


def history_text(extracts: Sequence[Extract], units: Mapping[str, str], terminal: Terminal, amount: Amount) -> str:
    """Return a summary of each file.

    Args:
        extracts: what was asked for.
        units: of signals, by key.
        terminal: that shows it.
        amount: writes a value with its unit.
    """
    return "\n".join(line for one in extracts for line in _of_file(one, units, terminal, amount)) + "\n"


def sparkline(points: Sequence[tuple[int, Point]], since: float, until: float, width: int, *, ascii_only: bool) -> str:
    """Return a series as ``width`` bars from its least to its greatest mean; a stretch without points is a gap."""
    if until <= since or width < 1:
        return ""
    bars = _ASCII_BARS if ascii_only else _BARS
    totals, counts = [0.0] * width, [0] * width
    for seconds, point in points:
        first = _place(point.time, since, until, width)
        for at in range(first, max(first, _place(point.time + seconds - 1e-6, since, until, width)) + 1):
            totals[at] += point.mean * point.count
            counts[at] += point.count
    means = [total / count if count else None for total, count in zip(totals, counts, strict=True)]
    known = [mean for mean in means if mean is not None]
    least, greatest = min(known, default=0.0), max(known, default=0.0)
    span = greatest - least
    steps = len(bars) - 1

    def bar(mean: float | None) -> str:
        if mean is None:
            return _GAP
        return bars[round((mean - least) / span * steps)] if span > abs(greatest) * 1e-9 else bars[steps // 2]

    return "".join(map(bar, means))


def _place(time: float, since: float, until: float, width: int) -> int:
    return min(max(math.floor((time - since) / (until - since) * width), 0), width - 1)


def _of_file(one: Extract, units: Mapping[str, str], terminal: Terminal, amount: Amount) -> Iterator[str]:
    title = f"{one.path}: {_clock(one.since)} to {_clock(one.until)}, {one.until - one.since:.0f} s"
    yield terminal.paint(terminal.clean(title), "title")
    if not (one.series or one.verdicts or one.events):
        yield "Nothing was kept of what was asked for."
        return
    yield from _series(one, units, terminal, amount)
    yield from _faults(one, terminal)
    if one.events:
        counts: dict[str, int] = {}
        for event in one.events:
            counts[event.change.value] = counts.get(event.change.value, 0) + 1
        yield "events: " + ", ".join(f"{count} {change}" for change, count in sorted(counts.items()))


def _series(one: Extract, units: Mapping[str, str], terminal: Terminal, amount: Amount) -> Iterator[str]:
    rows = [_row(kept, units.get(kept.signal, ""), amount) for kept in one.series]
    if not rows:
        return
    head = ("entity", "signal", "least", "mean", "greatest", "last")
    cells = [head, *((terminal.clean(row[0]), *row[1:]) for row in rows)]
    widths = [max(columns(row[at]) for row in cells) for at in range(len(head))]
    widths[0] = min(widths[0], max(terminal.width - sum(widths[1:]) - 2 * len(head) - 10, 12))
    room = max(terminal.width - sum(widths) - 2 * len(head), 10)
    for at, row in enumerate(cells):
        names = [left(terminal.cut(row[0], widths[0]), widths[0]), left(row[1], widths[1])]
        values = [right(cell, width) for cell, width in zip(row[2:], widths[2:], strict=True)]
        line = "  ".join([*names, *values])
        if at == 0:
            yield terminal.paint(line, "quiet")
            continue
        points = one.series[at - 1].points
        yield f"{line}  {sparkline(points, one.since, one.until, room, ascii_only=not terminal.unicode)}".rstrip()


def _row(kept: Kept, unit: str, amount: Amount) -> tuple[str, ...]:
    points = [point for _, point in kept.points]
    count = sum(point.count for point in points)
    mean = sum(point.mean * point.count for point in points) / count
    values = (min(one.least for one in points), mean, max(one.greatest for one in points), points[-1].mean)
    return (kept.entity, kept.signal, *(amount(value, unit) for value in values))


def _faults(one: Extract, terminal: Terminal) -> Iterator[str]:
    """Yield a line for each time something was wrong: from when on, for how long, what and why."""
    faults = list(_spells(one.verdicts))
    if not faults:
        return
    yield terminal.paint(f"what was wrong, {len(faults)} times:", "title")
    for verdict, over in faults[:_MOST_FAULTS]:
        lasted = f"for {over - verdict.since:.1f} s" if over is not None else "to the end"
        cause = f" because of {verdict.cause}" if verdict.cause else ""
        text = (
            f"{_clock(verdict.since)}  {verdict.state.value:7} {verdict.entity} {verdict.quantity} {lasted}{cause}"
            f"  {verdict.evidence}"
        )
        yield "  " + terminal.cut(terminal.clean(text), terminal.width - 2)
    if len(faults) > _MOST_FAULTS:
        yield f"  and {len(faults) - _MOST_FAULTS} more; --what verdicts --format csv has all"


def _spells(verdicts: Sequence[Verdict]) -> Iterator[tuple[Verdict, float | None]]:
    """Yield each stretch in which a constraint was broken, with when it ended; None where it had not."""
    begun: dict[tuple[str, str], int] = {}
    found: list[tuple[Verdict, float | None]] = []
    for verdict in verdicts:
        key = (str(verdict.entity), verdict.expectation)
        at = begun.get(key)
        if at is not None and verdict.state is found[at][0].state:
            continue
        if at is not None:
            found[at] = (found[at][0], verdict.since)
            del begun[key]
        if verdict.state.bad:
            begun[key] = len(found)
            found.append((verdict, None))
    yield from found


def _clock(time: float) -> str:
    return datetime.fromtimestamp(time).astimezone().strftime("%Y-%m-%d %H:%M:%S")
