"""Which past revisions the runs of a store are of."""

from __future__ import annotations

import sqlite3

import msgspec


class KeptRevision(msgspec.Struct, frozen=True):
    """A commit and the run that was made of it.

    Attributes:
        run: its number.
        commit: git's hash; of a workspace of several repositories a hash of all of theirs.
        key: of everything besides files that shaped the run.
        time_s: when it was committed, in seconds since 1970.
        commits: of a workspace of several repositories, by place of each; empty where it had none by then.
    """

    run: int
    commit: str
    key: str
    time_s: int
    commits: tuple[tuple[str, str], ...] = ()


_read_commits = msgspec.json.Decoder(tuple[tuple[str, str], ...]).decode


def write_revision(connection: sqlite3.Connection, one: KeptRevision) -> None:
    """Store the commit of a run."""
    connection.execute(
        'INSERT INTO revision (run, "commit", key, time_s, commits) VALUES (?, ?, ?, ?, ?) ON CONFLICT (run) DO UPDATE '
        'SET "commit" = excluded."commit", key = excluded.key, time_s = excluded.time_s, commits = excluded.commits',
        (one.run, one.commit, one.key, one.time_s, msgspec.json.encode(one.commits).decode()),
    )


def read_revisions(connection: sqlite3.Connection) -> tuple[KeptRevision, ...]:
    """Return all of them, the earliest first; of several runs of a commit the newest."""
    rows = connection.execute('SELECT run, "commit", key, time_s, commits FROM revision ORDER BY time_s, run')
    kept = (
        KeptRevision(run, commit, key, time_s, _read_commits(commits)) for run, commit, key, time_s, commits in rows
    )
    newest = {one.commit: one for one in kept}
    return tuple(sorted(newest.values(), key=lambda one: (one.time_s, one.run)))
