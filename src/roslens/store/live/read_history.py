"""What was kept of a live system, read back from its file; nothing is written, and who watches may go on meanwhile."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import msgspec

from roslens.model.errors import StoreError
from roslens.model.graph import Change, Event
from roslens.model.verdict import Verdict
from roslens.store.connect import connect
from roslens.store.live.history import WAIT_S
from roslens.store.live.series import TIERS, Point

_KEPT_TABLES = {"series", "point", "verdict", "event"}


class Kept(msgspec.Struct, frozen=True):
    """One series: entity and key of its signal, oldest point first, each with how many seconds it is long."""

    entity: str
    signal: str
    points: tuple[tuple[int, Point], ...]


class KeptHistory:
    """A history, open for reading; made by :func:`read_history`."""

    def __init__(self, connection: sqlite3.Connection, path: Path) -> None:
        self._connection = connection
        self.path = path

    def stretch(self) -> tuple[float, float] | None:
        """Return when the first and the last of what was kept was, in seconds since the epoch; None of nothing.

        Raises:
            StoreError: the file cannot be read.
        """
        with _as_errors(self.path):
            rows = self._connection.execute(
                "SELECT min(bucket), max(bucket + tier) FROM point WHERE tier = (SELECT min(tier) FROM point)"
                " UNION ALL SELECT min(bucket), NULL FROM point"
                " UNION ALL SELECT min(time), max(time) FROM verdict UNION ALL SELECT min(time), max(time) FROM event"
            ).fetchall()
        firsts = [row[0] for row in rows if row[0] is not None]
        lasts = [row[1] for row in rows if row[1] is not None]
        return (float(min(firsts)), float(max(lasts))) if firsts and lasts else None

    def series(self, since: float, until: float, wanted: Callable[[str, str], bool]) -> Iterator[Kept]:
        """Yield series by entity and signal, each moment in the finest resolution that is still there.

        Args:
            since: seconds since the epoch.
            until: the same.
            wanted: whether the series of an entity and a signal is.

        Raises:
            StoreError: the file cannot be read.
        """
        with _as_errors(self.path):
            names = self._connection.execute("SELECT id, entity, quantity FROM series ORDER BY entity, quantity")
            for number, entity, signal in names.fetchall():
                if wanted(entity, signal) and (points := self._points(number, since, until)):
                    yield Kept(entity, signal, points)

    def verdicts(self, since: float, until: float, wanted: Callable[[str, str], bool]) -> Iterator[Verdict]:
        """Yield changes of verdicts, oldest first.

        Raises:
            StoreError: the file cannot be read, or holds something else.
        """
        with _as_errors(self.path):
            rows = self._connection.execute(
                "SELECT content FROM verdict WHERE time BETWEEN ? AND ? ORDER BY time, id", (since, until)
            )
            for (content,) in rows:
                verdict = msgspec.json.decode(content, type=Verdict)
                if wanted(str(verdict.entity), verdict.quantity):
                    yield verdict

    def events(self, since: float, until: float, wanted: Callable[[str], bool]) -> Iterator[Event]:
        """Yield events of the graph, oldest first.

        Raises:
            StoreError: the file cannot be read, or holds something else.
        """
        with _as_errors(self.path):
            rows = self._connection.execute(
                "SELECT time, change, entity, detail FROM event WHERE time BETWEEN ? AND ? ORDER BY time, id",
                (since, until),
            )
            for time, change, entity, detail in rows:
                if wanted(entity):
                    yield Event(time, Change(change), entity, detail)

    def _points(self, series: int, since: float, until: float) -> tuple[tuple[int, Point], ...]:
        """Return the points of the finest tier, before those of it the next coarser one's, and so on."""
        found: list[tuple[int, Point]] = []
        for tier in TIERS:
            rows = self._connection.execute(
                "SELECT bucket, count, mean, least, greatest FROM point WHERE series = ? AND tier = ?"
                " AND bucket <= ? ORDER BY bucket",
                (series, tier.seconds, until),
            ).fetchall()
            found = _before(tier.seconds, [Point(*row) for row in rows], found)
        return tuple((seconds, point) for seconds, point in found if point.time + seconds > since)


def _before(seconds: int, coarse: list[Point], fine: list[tuple[int, Point]]) -> list[tuple[int, Point]]:
    """Return finer points and in front of them the coarser ones, of which one that reaches into them may know more."""
    if not fine:
        return [(seconds, point) for point in coarse]
    first = fine[0][1].time
    earlier = [(seconds, point) for point in coarse if point.time + seconds <= first]
    reaching = next((point for point in coarse if point.time < first < point.time + seconds), None)
    if reaching is None:
        return earlier + fine
    within = sum(point.count for _, point in fine if point.time < reaching.time + seconds)
    if reaching.count <= within:
        return earlier + fine
    later = [each for each in fine if each[1].time >= reaching.time + seconds]
    return [*earlier, (seconds, reaching), *later]


@contextmanager
def read_history(path: Path) -> Iterator[KeptHistory]:
    """Open what ``roslens watch --history`` wrote.

    Raises:
        StoreError: there is no such file, or something else is in it.
    """
    if not path.is_file():
        raise StoreError("there is no such file", where=str(path), expected=_EXPECTED, advice=_ADVICE)
    with _as_errors(path):
        connection = connect(path, wait_s=WAIT_S, writable=False)
    try:
        with _as_errors(path):
            tables = {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        if not tables >= _KEPT_TABLES:
            raise StoreError("this is not a history", where=str(path), expected=_EXPECTED, advice=_ADVICE)
        yield KeptHistory(connection, path)
    finally:
        connection.close()


_EXPECTED = "a file that `roslens watch --history FILE` wrote"
_ADVICE = "Name the file that was given to `--history`"


@contextmanager
def _as_errors(path: Path) -> Iterator[None]:
    try:
        yield
    except (sqlite3.Error, ValueError) as error:
        raise StoreError(f"it cannot be read: {error}", where=str(path), expected=_EXPECTED, advice=_ADVICE) from None
