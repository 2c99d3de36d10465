"""The file of the cache: made when missing, replaced when another roslens wrote it."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from roslens.model.failure import Failure
from roslens.model.source import Location
from roslens.store.connect import connect, write_ahead
from roslens.store.folder import prepare_folder

_WAIT_S = 2.0
_VERSION = 2
_LOG_PAGES = 16_000
_SCHEMA = f"""
BEGIN IMMEDIATE;
CREATE TABLE IF NOT EXISTS stat (path TEXT PRIMARY KEY, stat BLOB NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS facts (
    key TEXT PRIMARY KEY,
    size INTEGER NOT NULL,
    day INTEGER NOT NULL,
    number INTEGER NOT NULL
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS blob (number INTEGER PRIMARY KEY, content BLOB NOT NULL);
PRAGMA user_version = {_VERSION};
COMMIT;
"""


def open_cache_file(path: Path, *, writable: bool) -> sqlite3.Connection | None:
    """Open the file; one of another version is made anew, or is no use (None) where nothing may be written.

    Raises:
        sqlite3.Error: the file is damaged or cannot be opened.
        OSError: its folder cannot be made.
    """
    if writable and not path.exists():
        prepare_folder(path.parent)
    connection = connect(path, wait_s=_WAIT_S, writable=writable)
    try:
        version = connection.execute("PRAGMA user_version").fetchone()[0]
        if writable and version in {0, _VERSION}:
            if version == 0:
                write_ahead(connection)
                connection.executescript(_SCHEMA)
            # One long copy at the end costs less than many short ones.
            connection.execute(f"PRAGMA wal_autocheckpoint = {_LOG_PAGES}")
            return connection
    except BaseException:
        connection.close()
        raise
    if version == _VERSION:
        return connection
    connection.close()
    if not writable:
        return None
    remove_cache_file(path)
    return open_cache_file(path, writable=True)


def remove_cache_file(path: Path) -> None:
    """Remove the file and what SQLite keeps beside it.

    Raises:
        OSError: the folder cannot be written.
    """
    for suffix in ("", "-wal", "-shm"):
        path.with_name(path.name + suffix).unlink(missing_ok=True)


def cache_warning(path: Path | None, error: Exception, *, rebuilt: bool) -> Failure:
    """Return the message on a cache that failed."""
    return Failure(
        tool="cache",
        what=f"the cache cannot be used ({str(error)!r})",
        expected="a file that roslens wrote and may write",
        advice="A new one was made; this run takes longer" if rebuilt else "Results are the same; runs take longer",
        location=Location(str(path)) if path else None,
        partial=True,
    )


def foreign_entries(path: Path | None, count: int) -> Failure:
    """Return the message on entries that something else wrote."""
    return Failure(
        tool="cache",
        what=f"{count} of the entries in the cache were changed by something other than roslens of this user",
        expected="entries that this user's roslens wrote",
        advice="They are not used; this run takes longer",
        location=Location(str(path)) if path else None,
        partial=True,
    )
