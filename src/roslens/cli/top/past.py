"""The last values of each row, for sparklines: a snapshot holds only the newest."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from roslens.dashboard.live.snapshot import Snapshot

KEPT = 120
"""Snapshots; one comes each second."""
BARS = "▁▂▃▄▅▆▇█"
PLAIN_BARS = "_.-=+*#@"
GAP = " "


class Past:
    """Values by row and signal; None where a snapshot had none."""

    def __init__(self, kept: int = KEPT) -> None:
        """Keep so many snapshots."""
        self._kept = kept
        self._series: dict[tuple[str, str], deque[float | None]] = {}
        self._taken = 0
        self._time = float("-inf")

    def take(self, snapshot: Snapshot) -> None:
        """Keep what a snapshot has; the same one twice counts once."""
        if snapshot.time <= self._time:
            return
        self._time = snapshot.time
        there = {(row.entity, key): value for row in snapshot.rows for key, value in row.values.items()}
        for pair in there.keys() - self._series.keys():
            missed: list[float | None] = [None] * min(self._taken, self._kept)
            self._series[pair] = deque(missed, self._kept)
        for pair, series in self._series.items():
            series.append(there.get(pair))
        self._taken += 1
        for pair in [pair for pair, series in self._series.items() if all(value is None for value in series)]:
            del self._series[pair]

    def series(self, entity: str, key: str) -> tuple[float | None, ...]:
        """Return the values of a signal, the newest last; none of one that was never there."""
        return tuple(self._series.get((entity, key), ()))


def sparkline(values: Sequence[float | None], width: int, bars: str = BARS) -> str:
    """Return the newest values as bars from the least to the greatest of them; a gap where there was none.

    Values that are all alike are bars of middle height: they have no slope that could be shown.
    """
    shown = values[-width:]
    known = [value for value in shown if value is not None]
    if not known:
        return ""
    least, most = min(known), max(known)
    top = len(bars) - 1

    def bar(value: float | None) -> str:
        if value is None:
            return GAP
        return bars[top // 2] if most == least else bars[round((value - least) / (most - least) * top)]

    return "".join(map(bar, shown))
