"""One writer at a time: wait for the other one, or report it."""

from __future__ import annotations

import os
import sqlite3
import time
from collections.abc import Callable
from pathlib import Path

from roslens.model.errors import StoreError
from roslens.store.connect import roll_back
from roslens.store.postgres.connection import SharedConnection
from roslens.store.sqlite_errors import as_store_errors

_POLL_MS = 100

Waiting = Callable[[str], None]
"""Called once with the other process that is waited for."""


def claim(
    connection: sqlite3.Connection,
    path: Path | str | None,
    started: str,
    wait_s: float,
    waiting: Waiting | None = None,
) -> None:
    """Begin the one transaction that may write, or wait for the one that does.

    Who holds the lock must be readable by those who wait, so its name is committed first; the lock is then taken
    again, and the name checked, because another process may have slipped in between.

    Raises:
        StoreError: the lock was not free in time; names the process that holds it.
    """
    if not isinstance(connection, SharedConnection):
        _claim(connection, path, started, wait_s, waiting)
        return
    from roslens.store.postgres.claim import claim_shared

    with as_store_errors(path):
        claim_shared(connection, str(path), started, wait_s, waiting)


def writer_now(connection: sqlite3.Connection) -> str:
    """Return which other process writes at this moment; empty for none.

    Raises:
        sqlite3.Error: the store cannot be read.
    """
    if isinstance(connection, SharedConnection):
        from roslens.store.postgres.claim import shared_writer_now

        return shared_writer_now(connection)
    before = connection.execute("PRAGMA busy_timeout").fetchone()[0]
    connection.execute("PRAGMA busy_timeout = 0")
    try:
        connection.execute("BEGIN IMMEDIATE")
    except sqlite3.OperationalError as error:
        # A store that cannot be written has no known writer.
        return _writer(connection) if "locked" in str(error) else ""
    finally:
        release(connection)
        connection.execute(f"PRAGMA busy_timeout = {before}")
    return ""


def _claim(
    connection: sqlite3.Connection,
    path: Path | str | None,
    started: str,
    wait_s: float,
    waiting: Waiting | None,
) -> None:
    me = (os.getpid(), started)
    deadline = time.monotonic() + wait_s
    with as_store_errors(path):
        before = connection.execute("PRAGMA busy_timeout").fetchone()[0]
        # Short waits in SQLite, the long one here: an interrupt is then answered at once.
        connection.execute(f"PRAGMA busy_timeout = {_POLL_MS}")
        try:
            while True:
                _begin(connection, path, deadline, wait_s, waiting)
                waiting = None
                if connection.execute("SELECT pid, started FROM writer").fetchone() == me:
                    return
                connection.execute("INSERT OR REPLACE INTO writer (only, pid, started) VALUES (1, ?, ?)", me)
                connection.execute("COMMIT")
        except BaseException:
            release(connection)
            raise
        finally:
            connection.execute(f"PRAGMA busy_timeout = {before}")


def release(connection: sqlite3.Connection) -> None:
    """Discard what was not committed."""
    if isinstance(connection, SharedConnection):
        from roslens.store.postgres.claim import release_shared

        release_shared(connection)
        return
    roll_back(connection)


def _begin(
    connection: sqlite3.Connection,
    path: Path | str | None,
    deadline: float,
    wait_s: float,
    waiting: Waiting | None,
) -> None:
    while True:
        try:
            connection.execute("BEGIN IMMEDIATE")
        except sqlite3.OperationalError as error:
            if "locked" not in str(error):
                raise
            if time.monotonic() >= deadline:
                raise _taken(connection, path, wait_s) from error
            if waiting is not None:
                waiting(_writer(connection))
                waiting = None
        else:
            return


def _taken(connection: sqlite3.Connection, path: Path | str | None, wait_s: float) -> StoreError:
    return StoreError(
        f"another run is writing to the store ({_writer(connection)})",
        where=str(path or "the store in memory"),
        expected=f"the store to be free within {wait_s:g} s",
        advice="Wait until it is finished, or run with --no-store",
    )


def _writer(connection: sqlite3.Connection) -> str:
    pid, started = connection.execute("SELECT pid, started FROM writer").fetchone() or ("unknown", "")
    return f"process {pid}, started {started}" if started else f"process {pid}"
