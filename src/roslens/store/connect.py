"""Opening SQLite the way both the store and the cache need it, once or once per reader."""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Lock
from urllib.parse import quote


def connect(path: Path | None, *, wait_s: float, writable: bool = True) -> sqlite3.Connection:
    """Open the file, or a database in memory for None.

    Statements commit on their own unless a transaction was begun. Only one thread at a time may use a connection.
    A file in a folder that cannot be written (a read-only medium) can still be read.

    Args:
        path: of the file; it is made if it is missing and ``writable``.
        wait_s: how long a statement waits for another process's lock.
        writable: whether the file may be made and changed.

    Raises:
        sqlite3.Error: the file cannot be opened.
    """
    writable = writable and (path is None or os.access(path.parent, os.W_OK))
    connection = sqlite3.connect(
        _address(path, writable=writable),
        timeout=wait_s,
        isolation_level=None,
        check_same_thread=False,
        uri=True,
    )
    try:
        connection.execute("PRAGMA foreign_keys = ON")
        # With a write-ahead log, a power failure may then lose the last commit, never the file.
        connection.execute("PRAGMA synchronous = NORMAL")
    except BaseException:
        connection.close()
        raise
    return connection


class Readers:
    """Connections for readers: each has one to itself, so that any thread may read at any time.

    A store in memory has but one connection; there only one thread may read.
    """

    def __init__(
        self,
        path: Path | None,
        main: sqlite3.Connection,
        wait_s: float,
        open_one: Callable[[], sqlite3.Connection] | None = None,
    ) -> None:
        """``main`` is the connection of the store itself; ``open_one`` makes one where the store is no file."""
        self._path = path
        self._open_one = open_one
        self._main = main
        self._wait_s = wait_s
        self._idle: list[sqlite3.Connection] = []
        self._lock = Lock()
        self._closed = False
        self._process = os.getpid()
        self._of_parent: list[sqlite3.Connection] = []

    @contextmanager
    def one(self) -> Iterator[sqlite3.Connection]:
        """Lend a connection for the length of the block.

        Raises:
            sqlite3.Error: the file cannot be opened, or the store was closed.
        """
        if self._path is None and self._open_one is None:
            yield self._main
            return
        with self._lock:
            if self._closed:
                raise sqlite3.ProgrammingError("the store was closed")
            if self._process != os.getpid():
                # A copy of the process that opened them must neither use nor close its connections.
                self._of_parent, self._idle, self._process = self._idle, [], os.getpid()
            connection = self._idle.pop() if self._idle else None
        if connection is None and self._open_one is not None:
            connection = self._open_one()
        elif connection is None:
            connection = connect(self._path, wait_s=self._wait_s, writable=False)
        try:
            yield connection
        finally:
            self._take_back(connection)

    def wait_at_most(self, seconds: float) -> None:
        """Wait no longer than so many seconds for another process's lock from now on."""
        with self._lock:
            self._wait_s = min(self._wait_s, seconds)
            for connection in self._idle:
                connection.close()
            self._idle.clear()

    def _take_back(self, connection: sqlite3.Connection) -> None:
        with self._lock:
            if self._closed:
                connection.close()
            else:
                self._idle.append(connection)

    def close(self) -> None:
        """Close what is idle now, and the others when they come back."""
        with self._lock:
            self._closed = True
            for connection in self._idle:
                connection.close()
            self._idle.clear()


def roll_back(connection: sqlite3.Connection) -> None:
    """Discard what was not committed, and raise nothing of it: the error that led here is the one to report.

    On a full or failing disk SQLite may have ended the transaction itself, or fail to end it; the next one that opens
    the file discards it then.
    """
    if connection.in_transaction:
        with suppress(sqlite3.Error):
            connection.execute("ROLLBACK")


def write_ahead(connection: sqlite3.Connection) -> None:
    """Make a new file one whose last commit can be read while another process writes.

    Raises:
        sqlite3.Error: the file cannot be written.
    """
    # Only before the first page is written: freed pages can then be given back without rewriting the file.
    connection.execute("PRAGMA auto_vacuum = INCREMENTAL")
    connection.execute("PRAGMA journal_mode = WAL")


def shrink(connection: sqlite3.Connection) -> None:
    """Give pages that are no longer used back to the file system.

    Raises:
        sqlite3.Error: the file cannot be written.
    """
    # Not execute(): that takes a single step, and each step frees a single page.
    connection.executescript("PRAGMA incremental_vacuum")


def _address(path: Path | None, *, writable: bool) -> str:
    if path is None:
        return ":memory:"
    address = f"file:{quote(str(path.absolute()))}"
    if writable:
        return f"{address}?mode=rwc"
    # Without a log beside it the file is complete; SQLite could not make the log's index in such a folder anyway.
    alone = not os.access(path.parent, os.W_OK) and not path.with_name(path.name + "-wal").exists()
    return f"{address}?mode=ro&immutable=1" if alone else f"{address}?mode=ro"
