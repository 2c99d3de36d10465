"""Which past revisions the runs of a store are of."""

from __future__ import annotations

import sqlite3

import msgspec


class KeptRevision(msgspec.Struct, frozen=True):
    """A commit and the run that was made of it.

    Attributes:
        run: its number.
        commit: git's hash.
        key: of everything besides files that shaped the run.
        time_s: when it was committed, in seconds since 1970.
    """

    run: int
    commit: str
    key: str
    time_s: int


def write_revision(connection: sqlite3.Connection, one: KeptRevision) -> None:
    """Say of which commit a run is."""
    connection.execute(
        'INSERT INTO revision (run, "commit", key, time_s) VALUES (?, ?, ?, ?) ON CONFLICT (run) DO UPDATE SET '
        '"commit" = excluded."commit", key = excluded.key, time_s = excluded.time_s',
        (one.run, one.commit, one.key, one.time_s),
    )


def read_revisions(connection: sqlite3.Connection) -> tuple[KeptRevision, ...]:
    """Return all of them, the earliest first; of several runs of a commit the newest."""
    rows = connection.execute('SELECT run, "commit", key, time_s FROM revision ORDER BY time_s, run')
    newest = {one.commit: one for one in (KeptRevision(*row) for row in rows)}
    return tuple(sorted(newest.values(), key=lambda one: (one.time_s, one.run)))
