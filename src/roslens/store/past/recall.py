"""The history of a live system, asked for instants and stretches; every question is answered by an index."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import msgspec

from roslens.model.errors import StoreError
from roslens.model.graph import Change, Event
from roslens.model.verdict import State, Verdict
from roslens.store.live.series import TIERS, Tier
from roslens.store.past.moment import Moment, unpacked
from roslens.store.past.stretch import Piece, pieces

BINS = 240
"""Parts of a stretch of time for which marks are counted."""
MOST_MARKED = 100_000
"""Alarms, and events, that are counted for marks: of more, the newest."""
_LOOK_BACK_S = 3
"""Values of a busy monitor come less than once a second."""
_MOST_CHANGES = 200_000
_RETIRED = "judged no more"
_OWN = "roslens."


class Mark(msgspec.Struct, frozen=True, omit_defaults=True):
    """What happened in a part of a stretch of time.

    Attributes:
        time: of the first of them, seconds since the epoch.
        kind: ``alarm``, ``gone``, ``restart`` or ``change``.
        entity: text form of the id of the first one's entity.
        detail: of the first one.
        count: how many.
    """

    time: float
    kind: str
    entity: str
    detail: str = ""
    count: int = 1


_KINDS = {Change.VANISHED.value: "gone", Change.RESTARTED.value: "restart", Change.FLAPPING.value: "restart"}


class Recall:
    """Reads a history; may be asked from any thread."""

    def __init__(self, reader: Callable[[], AbstractContextManager[sqlite3.Connection]], where: str) -> None:
        """``reader`` lends a connection, ``where`` names its target in messages."""
        self._reader = reader
        self._where = where

    def span(self) -> tuple[float, float] | None:
        """Return the first and the last instant of which something is kept; None of nothing.

        Raises:
            StoreError: the history cannot be read.
        """
        with self._reading() as connection:
            firsts, lasts = _instants(connection)
            for tier in TIERS:
                bounds = _buckets(connection, tier)
                if bounds is None:
                    continue
                begin, end = bounds
                # A coarse bucket began before what is in it.
                if not firsts or begin + tier.seconds <= min(firsts):
                    firsts = [begin]
                lasts.append(end)
        return (float(min(firsts)), float(max(lasts))) if firsts else None

    def moment(self, time: float) -> Moment | None:
        """Return how the system stood at ``time``; None where nothing is kept of before.

        Raises:
            StoreError: the history cannot be read, or holds something else.
        """
        with self._reading() as connection:
            row = connection.execute(
                "SELECT content FROM moment WHERE time <= ? ORDER BY time DESC LIMIT 1", (time,)
            ).fetchone()
            if row is None:
                return None
            kept = unpacked(row[0])
            changes = connection.execute(
                "SELECT content FROM verdict WHERE time > ? AND time <= ? ORDER BY time, id LIMIT ?",
                (kept.time, time, _MOST_CHANGES),
            )
            verdicts = {(one.entity, one.expectation): one for one in kept.verdicts}
            for (content,) in changes:
                one = msgspec.json.decode(content, type=Verdict)
                key = one.entity, one.expectation
                if _over(one):
                    verdicts.pop(key, None)
                else:
                    verdicts[key] = one
        standing = tuple(verdicts[key] for key in sorted(verdicts))
        return msgspec.structs.replace(kept, time=time, verdicts=standing)

    def values(self, time: float) -> dict[str, dict[str, float]]:
        """Return the values of every entity at ``time``, by text form of its id and key of the signal.

        Raises:
            StoreError: the history cannot be read.
        """
        found: dict[str, dict[str, float]] = {}
        with self._reading() as connection:
            for tier in TIERS:
                back = _LOOK_BACK_S if tier.seconds == 1 else 0
                begin = int(time // tier.seconds) * tier.seconds
                rows = connection.execute(
                    "SELECT entity, quantity, mean FROM point JOIN series ON series.id = point.series"
                    " WHERE tier = ? AND bucket BETWEEN ? AND ? ORDER BY bucket",
                    (tier.seconds, begin - back, begin),
                )
                for entity, quantity, mean in rows:
                    found.setdefault(entity, {})[quantity] = mean
                if found:
                    break
        return found

    def stretches(
        self, entity: str, since: float, until: float, most: int, wanted: tuple[str, ...] = ()
    ) -> dict[str, tuple[Piece, ...]]:
        """Return series of an entity by key of the signal, all of them or those that are wanted.

        Raises:
            StoreError: the history cannot be read.
        """
        with self._reading() as connection:
            names = connection.execute("SELECT id, quantity FROM series WHERE entity = ? ORDER BY quantity", (entity,))
            found = {}
            for number, key in names.fetchall():
                if not wanted or key in wanted:
                    series = pieces(connection, number, since, until, most)
                    if series:
                        found[key] = series
        return found

    def happened(self, time: float, most: int) -> tuple[list[Event], list[Verdict]]:
        """Return the last changes of the graph and of verdicts up to ``time``, newest first.

        Raises:
            StoreError: the history cannot be read, or holds something else.
        """
        with self._reading() as connection:
            rows = connection.execute(
                "SELECT time, change, entity, detail FROM event WHERE time <= ? ORDER BY time DESC, id DESC LIMIT ?",
                (time, most),
            )
            events = [Event(when, Change(change), entity, detail) for when, change, entity, detail in rows]
            contents = connection.execute(
                "SELECT content FROM verdict WHERE time <= ? ORDER BY time DESC, id DESC LIMIT ?", (time, most)
            )
            verdicts = [msgspec.json.decode(content, type=Verdict) for (content,) in contents]
        return events, verdicts

    def marks(self, since: float, until: float) -> list[Mark]:
        """Return what happened in a stretch of time, at most one mark of a kind in each of :data:`BINS` parts.

        Of very much the newest is reported.

        Raises:
            StoreError: the history cannot be read.
        """
        width = max((until - since) / BINS, 0.001)
        found = []
        with self._reading() as connection:
            of_alarms, of_events = (_from(connection, table, since, until) for table in ("verdict", "event"))
            alarms = connection.execute(
                "SELECT min(time), count(*), entity, state FROM verdict INDEXED BY verdict_mark"
                " WHERE time BETWEEN ? AND ? AND state IN ('low', 'high', 'absent')"
                " GROUP BY CAST((time - ?) / ? AS INTEGER)",
                (of_alarms, until, since, width),
            )
            found += [Mark(time, "alarm", entity, state, count) for time, count, entity, state in alarms]
            events = connection.execute(
                "SELECT min(time), count(*), entity, change, detail FROM event"
                " WHERE time BETWEEN ? AND ? AND entity NOT LIKE 'process:%'"
                " GROUP BY CAST((time - ?) / ? AS INTEGER), change",
                (of_events, until, since, width),
            )
            for time, count, entity, change, detail in events:
                kind = _KINDS.get(change, "change")
                found.append(Mark(time, kind, entity, detail or change, count))
        return sorted(found, key=lambda one: (one.time, one.kind, one.entity))

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection]:
        try:
            with self._reader() as connection:
                yield connection
        except (sqlite3.Error, ValueError) as error:
            raise StoreError(
                f"the history cannot be read: {error}",
                where=self._where,
                expected="what `roslens watch` wrote",
                advice="What is now is shown all the same",
            ) from None


def _instants(connection: sqlite3.Connection) -> tuple[list[float], list[float]]:
    """Return the first and the last instant of each table that has any, of those that have instants."""
    firsts, lasts = [], []
    for table in ("moment", "verdict", "event"):
        # One bound at a time: only then SQLite takes it from an end of the index.
        (first,) = connection.execute(f"SELECT min(time) FROM {table}").fetchone()  # noqa: S608 - names above
        (last,) = connection.execute(f"SELECT max(time) FROM {table}").fetchone()  # noqa: S608 - names above
        if first is not None:
            firsts.append(first)
            lasts.append(last)
    return firsts, lasts


def _buckets(connection: sqlite3.Connection, tier: Tier) -> tuple[float, float] | None:
    """Return where the first and the last bucket of a tier begin; None of an empty one."""
    (first,) = connection.execute("SELECT min(bucket) FROM point WHERE tier = ?", (tier.seconds,)).fetchone()
    if first is None:
        return None
    (last,) = connection.execute("SELECT max(bucket) FROM point WHERE tier = ?", (tier.seconds,)).fetchone()
    return first, last


def _from(connection: sqlite3.Connection, table: str, since: float, until: float) -> float:
    """Return from when on the newest of a stretch are, as many as are counted."""
    row = connection.execute(
        f"SELECT time FROM {table} WHERE time <= ? AND time > ? ORDER BY time DESC LIMIT 1 OFFSET ?",  # noqa: S608
        (until, since, MOST_MARKED - 1),
    ).fetchone()
    return float(row[0]) if row is not None else since


def _over(one: Verdict) -> bool:
    """Whether a verdict states that its entity is no longer judged."""
    if one.state is State.UNKNOWN and one.evidence == _RETIRED:
        return True
    # Nodes that are gone or stopped are judged by no constraint; back again, nothing judges them.
    return one.expectation.startswith(_OWN) and not one.state.bad and one.entity.kind.value == "node"
