"""One writer of a shared store at a time: a lock of the server, which is free when its holder is gone."""

from __future__ import annotations

import os
import socket
import sqlite3
import time
from contextlib import suppress

from roslens.model.errors import StoreError
from roslens.store.connect import roll_back
from roslens.store.postgres.connection import SharedConnection
from roslens.store.postgres.migrate import LOCK

_POLL_S = 0.1


def claim_shared(connection: SharedConnection, where: str, started: str, wait_s: float) -> None:
    """Begin the one transaction that may write, or wait for the one that does.

    Raises:
        StoreError: the lock was not free in time; names the process that has it.
    """
    deadline = time.monotonic() + wait_s
    while not connection.execute(f"SELECT pg_try_advisory_lock({LOCK}, hashtext(current_schema()))").fetchone()[0]:
        if time.monotonic() >= deadline:
            pid, since = connection.execute("SELECT pid, started FROM writer").fetchone() or ("unknown", "")
            raise StoreError(
                f"another run is writing to the store (process {pid} on {since})",
                where=where,
                expected=f"the store to be free within {wait_s:g} s",
                advice="Wait until it is finished, or run with --no-store",
            )
        time.sleep(_POLL_S)
    # Committed at once, so that those who wait can read it.
    me = (os.getpid(), f"{socket.gethostname()}, started {started}")
    connection.execute("INSERT OR REPLACE INTO writer (only, pid, started) VALUES (1, ?, ?)", me)
    connection.execute("BEGIN")


def release_shared(connection: SharedConnection) -> None:
    """Discard what was not committed, and let others write; a server that is gone has done both."""
    roll_back(connection)
    with suppress(sqlite3.Error):
        connection.execute(f"SELECT pg_advisory_unlock({LOCK}, hashtext(current_schema()))")
