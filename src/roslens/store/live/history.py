"""The history of a live system: series, verdicts and events in one SQLite file, bounded by age."""

from __future__ import annotations

import math
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from threading import RLock
from types import TracebackType
from weakref import finalize

import msgspec

from roslens.model.graph import Change, Event
from roslens.model.verdict import Verdict
from roslens.store.connect import Readers, connect, roll_back, shrink
from roslens.store.encodable import encodable
from roslens.store.folder import prepare_folder
from roslens.store.live.series import TIERS, DownSampler, Point, Tier, tier_for
from roslens.store.migrate import migrate
from roslens.store.past.moment import Moment, packed
from roslens.store.past.recall import Recall
from roslens.store.sqlite_errors import as_store_errors

SCHEMA = Path(__file__).with_name("live_schema")
WAIT_S = 10.0
KEPT_VERDICTS_S = 90 * 86_400
SILENT_S = 60.0
"""After which the buckets of a series are written as they are; what comes later in one is added to it."""


_ADD_POINT = """
INSERT INTO point VALUES (?, ?, ?, ?, ?, ?, ?)
ON CONFLICT (series, tier, bucket) DO UPDATE SET
    mean = (mean * count + excluded.mean * excluded.count) / (count + excluded.count),
    count = count + excluded.count,
    least = min(least, excluded.least),
    greatest = max(greatest, excluded.greatest)
"""
"""After a silence, or a restart, a bucket may come in two parts."""

_THIN_MOMENTS = """
DELETE FROM moment WHERE time < :before AND time > (SELECT min(time) FROM moment) AND EXISTS (
    SELECT 1 FROM moment AS later
    WHERE later.time > moment.time AND later.time < (CAST(moment.time / :bucket AS INTEGER) + 1) * :bucket
)
"""
"""Where what is kept begins stays."""
_EMPTY_SERIES = "SELECT id FROM series WHERE NOT EXISTS (SELECT 1 FROM point WHERE point.series = series.id)"
"""Of what came and went: of tools of the command line, of processes."""


class History:
    """What a live system did; one writer, any number of readers. A context manager."""

    def __init__(self, connection: sqlite3.Connection, path: Path | None, tiers: tuple[Tier, ...] = TIERS) -> None:
        """Use :meth:`open`."""
        self._tiers = tiers
        self._connection = connection
        self._path = path
        self._readers = Readers(path, connection, WAIT_S)
        self._sampler = DownSampler(tiers)
        self._ids: dict[tuple[str, str], int] = {}
        self._points: list[tuple[int, int, int, int, float, float, float]] = []
        self._verdicts: list[Verdict] = []
        self._events: list[Event] = []
        self._moments: list[Moment] = []
        # In memory there is one connection for all threads, and who reads must not see half a transaction.
        self._alone = RLock()
        if path is None:
            # What is in memory ends with its last user, who need not close it.
            finalize(self, connection.close)

    @classmethod
    def open(cls, path: Path | None, tiers: tuple[Tier, ...] = TIERS) -> History:
        """Open the history at ``path``, made if it is missing; None keeps it in memory.

        Args:
            path: of the file.
            tiers: how fine values are kept, and how long; verdicts as long as the coarsest.

        Raises:
            StoreError: the file cannot be used.
        """
        with as_store_errors(path):
            if path is not None:
                prepare_folder(path.parent)
            connection = connect(path, wait_s=WAIT_S)
            try:
                migrate(connection, path, SCHEMA)
            except BaseException:
                connection.close()
                raise
        return cls(connection, path, tiers)

    def __enter__(self) -> History:
        """Return itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Write what waits, then close."""
        try:
            self.flush(final=True)
        finally:
            self._readers.close()
            self._connection.close()

    def add_values(self, entity: str, time: float, values: Mapping[str, float]) -> None:
        """Take the values of an entity at ``time``; they are written with the next flush after their second."""
        for owner, quantity, tier, point in self._sampler.add(entity, time, values):
            self._keep(owner, quantity, tier, point)

    def add_verdicts(self, verdicts: Iterable[Verdict]) -> None:
        """Take verdicts that changed."""
        self._verdicts += verdicts

    def add_events(self, events: Iterable[Event]) -> None:
        """Take events of the graph."""
        self._events += events

    def add_moment(self, moment: Moment) -> None:
        """Take how everything stands; what is asked later of an instant begins with the moment before it."""
        self._moments.append(moment)

    def flush(self, *, final: bool = False) -> None:
        """Write what waits in one transaction; ``final`` also what is not over yet.

        Raises:
            StoreError: the file cannot be written.
        """
        if final:
            for owner, quantity, tier, point in self._sampler.rest():
                self._keep(owner, quantity, tier, point)
        if not (self._points or self._verdicts or self._events or self._moments):
            return
        with self._alone, as_store_errors(self._path):
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                self._write()
                self._connection.execute("COMMIT")
            except BaseException:
                roll_back(self._connection)
                raise
        self._points.clear()
        self._verdicts.clear()
        self._events.clear()
        self._moments.clear()

    def let_go(self, now: float) -> None:
        """Write what is known of series that fell silent, and keep no more of them in memory.

        Raises:
            StoreError: the file cannot be written.
        """
        silent = set()
        for owner, quantity, tier, point in self._sampler.forget(now - SILENT_S):
            self._keep(owner, quantity, tier, point)
            silent.add((owner, quantity))
        self.flush()
        for one in silent:
            self._ids.pop(one, None)

    def prune(self, now: float) -> None:
        """Give up what is older than its tier is kept for.

        Of how everything stood, one instant is left in each bucket of the finest tier that reaches so far back.

        Raises:
            StoreError: the file cannot be written.
        """
        self.let_go(now)
        with self._alone, as_store_errors(self._path):
            kept = self._tiers[-1].kept_s
            for tier in self._tiers:
                self._connection.execute(
                    "DELETE FROM point WHERE tier = ? AND bucket < ?", (tier.seconds, int(now - tier.kept_s))
                )
            for table in ("verdict", "event"):
                self._connection.execute(f"DELETE FROM {table} WHERE time < ?", (now - kept,))  # noqa: S608
            # The last one before is where what is kept begins.
            self._connection.execute(
                "DELETE FROM moment WHERE time < (SELECT max(time) FROM moment WHERE time <= ?)",
                (now - kept,),
            )
            for tier, coarser in pairwise(self._tiers):
                self._connection.execute(_THIN_MOMENTS, {"before": now - tier.kept_s, "bucket": coarser.seconds})
            used = set(self._ids.values())
            empty = [one for (one,) in self._connection.execute(_EMPTY_SERIES) if one not in used]
            self._connection.executemany("DELETE FROM series WHERE id = ?", [(one,) for one in empty])
            shrink(self._connection)

    def recall(self) -> Recall:
        """Return what reads this history, from any thread."""
        return Recall(self._lent, str(self._path or "in memory"))

    @contextmanager
    def _lent(self) -> Iterator[sqlite3.Connection]:
        if self._path is None:
            with self._alone:
                yield self._connection
        else:
            with self._readers.one() as connection:
                yield connection

    @property
    def size(self) -> int:
        """Bytes that it takes, in its file or in memory.

        Raises:
            StoreError: the file cannot be read.
        """
        with self._alone, as_store_errors(self._path):
            found = (self._connection.execute(f"PRAGMA {one}").fetchone()[0] for one in ("page_count", "page_size"))
            return math.prod(map(int, found))

    def points(self, entity: str, quantity: str, since: float, until: float, *, most: int = 600) -> tuple[Point, ...]:
        """Return a series from ``since`` to ``until`` in at most ``most`` points, oldest first.

        Raises:
            StoreError: the file cannot be read.
        """
        tier = tier_for(until - since, most)
        with as_store_errors(self._path), self._readers.one() as connection:
            rows = connection.execute(
                "SELECT bucket, count, mean, least, greatest FROM point JOIN series ON series.id = point.series"
                " WHERE entity = ? AND quantity = ? AND tier = ? AND bucket BETWEEN ? AND ? ORDER BY bucket",
                (entity, quantity, tier.seconds, int(since), int(until)),
            )
            return tuple(Point(*row) for row in rows)

    def verdicts(self, since: float, until: float, *, entity: str = "") -> tuple[Verdict, ...]:
        """Return the changes of verdicts in a stretch of time, oldest first; of one entity where one is given.

        Raises:
            StoreError: the file cannot be read.
        """
        with as_store_errors(self._path), self._readers.one() as connection:
            rows = connection.execute(
                "SELECT content FROM verdict WHERE time BETWEEN ? AND ? AND (? = '' OR entity = ?) ORDER BY time, id",
                (since, until, entity, entity),
            )
            return tuple(msgspec.json.decode(row[0], type=Verdict) for row in rows)

    def events(self, since: float, until: float) -> tuple[Event, ...]:
        """Return the events in a stretch of time, oldest first.

        Raises:
            StoreError: the file cannot be read.
        """
        with as_store_errors(self._path), self._readers.one() as connection:
            rows = connection.execute(
                "SELECT time, change, entity, detail FROM event WHERE time BETWEEN ? AND ? ORDER BY time, id",
                (since, until),
            )
            return tuple(Event(time, Change(change), entity, detail) for time, change, entity, detail in rows)

    def _keep(self, entity: str, quantity: str, tier: Tier, point: Point) -> None:
        series = self._id(entity, quantity)
        self._points.append((series, tier.seconds, point.time, point.count, point.mean, point.least, point.greatest))

    def _id(self, entity: str, quantity: str) -> int:
        known = self._ids.get((entity, quantity))
        if known is None:
            with self._alone, as_store_errors(self._path):
                self._connection.execute(
                    "INSERT OR IGNORE INTO series (entity, quantity) VALUES (?, ?)", (_storable(entity), quantity)
                )
                row = self._connection.execute(
                    "SELECT id FROM series WHERE entity = ? AND quantity = ?", (_storable(entity), quantity)
                ).fetchone()
            known = self._ids[entity, quantity] = int(row[0])
        return known

    def _write(self) -> None:
        self._connection.executemany(_ADD_POINT, self._points)
        self._connection.executemany(
            "INSERT INTO verdict (time, entity, state, content) VALUES (?, ?, ?, ?)",
            [(one.time, _storable(str(one.entity)), one.state.value, _json(one)) for one in self._verdicts],
        )
        self._connection.executemany(
            "INSERT INTO event (time, entity, change, detail) VALUES (?, ?, ?, ?)",
            [(one.time, _storable(one.entity), one.change.value, _storable(one.detail)) for one in self._events],
        )
        self._connection.executemany(
            "INSERT OR REPLACE INTO moment (time, content) VALUES (?, ?)",
            [(one.time, packed(one)) for one in self._moments],
        )


def _json(verdict: Verdict) -> str:
    try:
        return msgspec.json.encode(verdict).decode()
    except UnicodeEncodeError:
        return msgspec.json.encode(encodable(verdict)).decode()


def _storable(text: str) -> str:
    """Return ``text`` as SQLite takes it: lone surrogates, which no encoding has, become question marks."""
    return text.encode("utf-8", "replace").decode()
