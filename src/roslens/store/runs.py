"""The store: complete runs, the units they share, and the one run that is being written."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

import msgspec

from roslens.model.errors import StoreError
from roslens.model.result import PackageResult, PackageSummary, RunHeader
from roslens.store import rows
from roslens.store.connect import Readers, connect, roll_back, shrink
from roslens.store.folder import prepare_folder
from roslens.store.migrate import migrate
from roslens.store.question import Run
from roslens.store.read import RunView, read_unit
from roslens.store.sealing.sealing import SealedFile, Sealing
from roslens.store.sqlite_errors import as_store_errors
from roslens.store.writing.lock import Waiting, claim, release, writer_now

if TYPE_CHECKING:
    from roslens.store.revisions import KeptRevision
    from roslens.store.writing.write import RunWriter

WAIT_S = 10.0
"""How long a run waits for another one that is writing."""


class StoredRun(msgspec.Struct, frozen=True):
    """A complete run with how much it holds."""

    id: int
    header: RunHeader
    packages: int
    files: int
    entities: int
    findings: int
    failures: int


class Store:
    """All complete runs of a workspace; a context manager.

    One thread uses the store itself; any number of threads may read through its views (in memory: one).
    """

    def __init__(
        self,
        connection: sqlite3.Connection,
        path: Path | str | None,
        wait_s: float,
        open_one: Callable[[], sqlite3.Connection] | None = None,
        sealed: SealedFile | None = None,
    ) -> None:
        """Use :meth:`open` or :meth:`open_shared`."""
        self._sealed = sealed
        self._connection = connection
        self._path = path
        self._wait_s = wait_s
        self._readers = Readers(path if isinstance(path, Path) else None, connection, wait_s, open_one)

    @classmethod
    def open(cls, path: Path | None, *, wait_s: float = WAIT_S, sealing: Sealing | None = None) -> Store:
        """Open the store at ``path``, made if it is missing; None keeps everything in memory.

        Args:
            path: of the SQLite file.
            wait_s: how long to wait for another process that is writing.
            sealing: what it is sealed with: one that something else changed is set aside, which is said in a line, and
                a new one is made; where that cannot be done, in memory.

        Raises:
            StoreError: the file cannot be opened, is no store, or a newer roslens wrote it.
        """
        sealed = None if path is None or sealing is None else SealedFile(path, sealing)
        with as_store_errors(path):
            if path is not None and not path.exists():
                prepare_folder(path.parent)
            connection = cls._connected(path, wait_s, sealed)
        if connection is not None:
            return cls(connection, path, wait_s, sealed=sealed)
        assert sealed is not None  # noqa: S101 - only for the type checker
        return cls.open(path if sealed.put_aside() else None, wait_s=wait_s, sealing=sealing)

    @staticmethod
    def _connected(path: Path | None, wait_s: float, sealed: SealedFile | None) -> sqlite3.Connection | None:
        """Return a connection to the store in its newest schema; None where it is not as this user left it."""
        try:
            connection = connect(path, wait_s=wait_s)
        except sqlite3.DatabaseError as error:
            if sealed is None or isinstance(error, sqlite3.OperationalError):
                raise
            return None
        try:
            if sealed is not None and not sealed.is_own(connection):
                connection.close()
                return None
            version = connection.execute("PRAGMA user_version").fetchone()[0]
            migrate(connection, path)
            if sealed is not None:
                sealed.begin(connection, version)
        except BaseException:
            connection.close()
            raise
        return connection

    @classmethod
    def open_shared(cls, address: str, *, wait_s: float = WAIT_S) -> Store:
        """Open the store in a database of PostgreSQL; its tables are made if they are missing.

        Args:
            address: ``postgresql://…``; ``?schema=NAME`` tells the stores of several workspaces apart.
            wait_s: how long to wait for the server, and for another process that is writing.

        Raises:
            UsageError: psycopg is not installed, or the address is none.
            StoreError: the server does not let in, or a newer roslens wrote the store.
        """
        from roslens.store.postgres.connection import connect_shared, shown
        from roslens.store.postgres.migrate import migrate_shared

        where = shown(address)
        with as_store_errors(where):
            connection = connect_shared(address, wait_s=wait_s)
            try:
                migrate_shared(connection, where)
            except BaseException:
                connection.close()
                raise
        return cls(connection, where, wait_s, lambda: connect_shared(address, wait_s=wait_s))

    def close(self) -> None:
        """Close the file; views of this store are of no more use."""
        if self._sealed is not None:
            self._sealed.before_writing()
        self._readers.close()
        self._connection.close()
        if self._sealed is not None:
            self._sealed.closed()

    def __enter__(self) -> Store:
        """Return the store itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the file."""
        self.close()

    def run_with(self, key: str) -> int | None:
        """Return the newest complete run of this key.

        Raises:
            StoreError: the store cannot be read.
        """
        with as_store_errors(self._path):
            return self._connection.execute("SELECT max(id) FROM run WHERE key = ?", (key,)).fetchone()[0]  # type: ignore[no-any-return]

    def latest(self) -> int | None:
        """Return the newest complete run.

        Raises:
            StoreError: the store cannot be read.
        """
        with as_store_errors(self._path):
            return self._connection.execute("SELECT max(id) FROM run").fetchone()[0]  # type: ignore[no-any-return]

    def has_unit(self, key: str) -> bool:
        """Return whether the result of a package is kept under ``key``.

        Raises:
            StoreError: the store cannot be read.
        """
        with as_store_errors(self._path):
            return self._connection.execute("SELECT 1 FROM unit WHERE key = ?", (key,)).fetchone() is not None

    def unit(self, key: str) -> PackageResult | None:
        """Return the result kept under ``key``, without what only the packages together show.

        Raises:
            StoreError: the store cannot be read.
        """
        with as_store_errors(self._path):
            found = self._connection.execute("SELECT id FROM unit WHERE key = ?", (key,)).fetchone()
            return read_unit(self._connection, found[0]) if found else None

    def unit_summary(self, key: str) -> PackageSummary | None:
        """Return the summary of the result kept under ``key``.

        Raises:
            StoreError: the store cannot be read.
        """
        with as_store_errors(self._path):
            found = self._connection.execute("SELECT summary FROM unit WHERE key = ?", (key,)).fetchone()
            return rows.to_summary(found[0]) if found else None

    def writing(self, header: RunHeader, waiting: Waiting | None = None) -> RunWriter:
        """Return the writer of a new run, to be used in a ``with`` block; see :class:`RunWriter`.

        Args:
            header: of the run.
            waiting: called with the process that is waited for, where another one is writing.
        """
        # Imported late: a run in which nothing changed writes nothing.
        from roslens.store.writing.write import RunWriter

        return RunWriter(self._connection, self._path, header.started, self._wait_s, waiting, self._sealed)

    def runs(self) -> tuple[StoredRun, ...]:
        """Return all complete runs, newest first.

        Raises:
            StoreError: the store cannot be read.
        """
        with as_store_errors(self._path):
            found = self._connection.execute(
                f"SELECT id, packages, files, entities, findings, failures, {rows.RUN} FROM run ORDER BY id DESC"  # noqa: S608 - column names of rows.py
            ).fetchall()
        return tuple(StoredRun(row[0], rows.to_header(row[6:]), *row[1:6]) for row in found)

    def view(self, run: int | None = None) -> RunView:
        """Return what there is to read of a run; of the newest one for None.

        Raises:
            StoreError: there is no such run, or the store cannot be read.
        """
        number = self.latest() if run is None else run
        where = str(self._path or "the store in memory")
        if number is None:
            with as_store_errors(self._path):
                writer = writer_now(self._connection)
            if writer:
                raise StoreError(
                    f"no run was completed yet; the first one is being made ({writer})",
                    where=where,
                    advice="Wait until it is finished",
                )
            raise StoreError("no run was completed yet", where=where, advice="Run `roslens check` first")
        with as_store_errors(self._path):
            found = self._connection.execute(f"SELECT {rows.RUN} FROM run WHERE id = ?", (number,)).fetchone()  # noqa: S608 - column names of rows.py
        if found is None:
            with as_store_errors(self._path):
                known = [row[0] for row in self._connection.execute("SELECT id FROM run ORDER BY id")]
            raise StoreError(
                f"there is no run {number}",
                where=where,
                expected=f"one of {', '.join(map(str, known[-10:]))}" if known else "a complete run",
                advice="" if known else "Run `roslens check` first",
            )
        return RunView(Run(self._readers, self._path, number), rows.to_header(found))

    def mark_revision(self, one: KeptRevision) -> None:
        """Store the past commit of a run.

        Raises:
            StoreError: the store cannot be written.
        """
        from roslens.store.revisions import write_revision

        with as_store_errors(self._path), self._sealing(("run", one.run)):
            write_revision(self._connection, one)

    def revisions(self) -> tuple[KeptRevision, ...]:
        """Return the past commits of which there are runs, the earliest first.

        Raises:
            StoreError: the store cannot be read.
        """
        from roslens.store.revisions import read_revisions

        with as_store_errors(self._path):
            return read_revisions(self._connection)

    def summaries(self, runs: Sequence[int]) -> dict[int, tuple[PackageSummary, ...]]:
        """Return the summaries of the packages of several runs; what runs share is read once.

        What only all packages together show is among their values; their findings are those of their own units.

        Raises:
            StoreError: the store cannot be read.
        """
        from roslens.store.shared_summaries import read_summaries

        with as_store_errors(self._path):
            return read_summaries(self._connection, runs)

    def prune(self, keep: int) -> int:
        """Remove all but the newest ``keep`` runs with everything only they hold; return how many were removed.

        Raises:
            StoreError: the store cannot be written, or another run is being written.
        """
        if self._sealed is not None:
            self._sealed.before_writing()
        claim(self._connection, self._path, "to remove old runs", self._wait_s)
        try:
            with as_store_errors(self._path):
                removed = self._connection.execute(
                    "DELETE FROM run WHERE id NOT IN (SELECT id FROM run ORDER BY id DESC LIMIT ?)", (max(0, keep),)
                ).rowcount
                self._connection.execute(
                    "DELETE FROM unit WHERE id NOT IN (SELECT unit FROM run_unit UNION SELECT workspace FROM run)"
                )
                self._connection.execute("DELETE FROM vocabulary WHERE id NOT IN (SELECT vocabulary FROM run)")
                self._connection.execute("DELETE FROM graph WHERE id NOT IN (SELECT graph FROM configuration)")
                self._connection.execute("DELETE FROM process WHERE id NOT IN (SELECT process FROM run_process)")
                if self._sealed is not None:
                    self._sealed.seal(self._connection)
                self._connection.execute("COMMIT")
                if isinstance(self._path, Path):
                    shrink(self._connection)
                if self._sealed is not None:
                    self._sealed.written()
        finally:
            release(self._connection)
        return removed

    @contextmanager
    def _sealing(self, changed: tuple[str, int]) -> Iterator[None]:
        """Seal what the block changes of a row that was sealed before."""
        if self._sealed is None:
            yield
            return
        self._sealed.before_writing()
        self._connection.execute("BEGIN IMMEDIATE")
        try:
            yield
            self._sealed.seal(self._connection, [changed])
            self._connection.execute("COMMIT")
        except BaseException:
            roll_back(self._connection)
            raise
        self._sealed.written()
