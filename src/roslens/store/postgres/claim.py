"""One writer of a shared store at a time: a lock of the server, which is free when its holder is gone."""

from __future__ import annotations

import os
import socket
import sqlite3
import time
from collections.abc import Callable
from contextlib import suppress

from roslens.model.errors import StoreError
from roslens.store.connect import roll_back
from roslens.store.postgres.connection import SharedConnection
from roslens.store.postgres.migrate import LOCK

_POLL_S = 0.1


def claim_shared(
    connection: SharedConnection,
    where: str,
    started: str,
    wait_s: float,
    waiting: Callable[[str], None] | None = None,
) -> None:
    """Begin the one transaction that may write, or wait for the one that does.

    Raises:
        StoreError: the lock was not free in time; names the process that has it.
    """
    deadline = time.monotonic() + wait_s
    while not _locked(connection):
        if time.monotonic() >= deadline:
            raise StoreError(
                f"another run is writing to the store ({_writer(connection)})",
                where=where,
                expected=f"the store to be free within {wait_s:g} s",
                advice="Wait until it is finished, or run with --no-store",
            )
        if waiting is not None:
            waiting(_writer(connection))
            waiting = None
        time.sleep(_POLL_S)
    # Committed at once, so that those who wait can read it.
    me = (os.getpid(), f"{socket.gethostname()}, started {started}")
    connection.execute("INSERT OR REPLACE INTO writer (only, pid, started) VALUES (1, ?, ?)", me)
    connection.execute("BEGIN")


def shared_writer_now(connection: SharedConnection) -> str:
    """Return which other process writes at this moment; empty for none."""
    if not _locked(connection):
        return _writer(connection)
    _unlock(connection)
    return ""


def release_shared(connection: SharedConnection) -> None:
    """Discard what was not committed, and let others write; a server that is gone has done both."""
    roll_back(connection)
    with suppress(sqlite3.Error):
        _unlock(connection)


def _locked(connection: SharedConnection) -> bool:
    return bool(connection.execute(f"SELECT pg_try_advisory_lock({LOCK}, hashtext(current_schema()))").fetchone()[0])


def _unlock(connection: SharedConnection) -> None:
    connection.execute(f"SELECT pg_advisory_unlock({LOCK}, hashtext(current_schema()))")


def _writer(connection: SharedConnection) -> str:
    pid, since = connection.execute("SELECT pid, started FROM writer").fetchone() or ("unknown", "an unknown machine")
    return f"process {pid} on {since}"
