"""Writing one run: everything in one transaction, invisible before it is complete."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from hashlib import blake2b
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from roslens.model.entity import EntityKind
from roslens.model.errors import StoreError
from roslens.model.result import PackageResult, PackageSummary, RunHeader, WorkspaceResult
from roslens.model.source import OUTSIDE_PACKAGES, number_of_packages
from roslens.store import rows
from roslens.store.columns import numbers_of
from roslens.store.encodable import encodable, storable_values
from roslens.store.rows import Row
from roslens.store.sqlite_errors import as_store_errors
from roslens.store.summary import rule_counts
from roslens.store.writing.lock import Waiting, claim, release
from roslens.store.writing.unit_rows import UnitRows, rows_of_failures, rows_of_findings, rows_of_set_aside, unit_rows

if TYPE_CHECKING:
    from roslens.model.judged_configuration import JudgedConfiguration
    from roslens.store.configurations import PackedConfiguration
    from roslens.store.sealing.sealing import SealedFile


class RunWriter:
    """Collects the units of one run; a context manager made by :meth:`roslens.store.runs.Store.writing`.

    Inside the block the store is locked for other writers; readers keep seeing the runs before. Leaving the block
    without :meth:`complete` discards everything, and so does the death of the process.
    """

    def __init__(
        self,
        connection: sqlite3.Connection,
        path: Path | str | None,
        started: str,
        wait_s: float,
        waiting: Waiting | None = None,
        sealed: SealedFile | None = None,
    ) -> None:
        """Use :meth:`roslens.store.runs.Store.writing`.

        Args:
            connection: of the store.
            path: of the store, for messages.
            started: tells a waiting process whom it waits for.
            wait_s: how long this one waits.
            waiting: called with whom.
            sealed: the seals of the store; None where it has none.
        """
        self._sealed = sealed
        self._connection = connection
        self._path = path
        self._started = started
        self._wait_s = wait_s
        self._waiting = waiting
        self._units: dict[int, str] = {}

    def __enter__(self) -> RunWriter:
        """Lock the store for writing.

        Raises:
            StoreError: another process has been writing for all of the time allowed.
        """
        if self._sealed is not None:
            self._sealed.before_writing()
        claim(self._connection, self._path, self._started, self._wait_s, self._waiting)
        with as_store_errors(self._path):
            self._tag_sets = _TagSets(self._connection)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Discard the run unless it is complete."""
        release(self._connection)

    def add(self, key: str, result: PackageResult, *, brief: bool = False) -> None:
        """Keep a package's result under ``key``; findings are kept in order of their places.

        Args:
            key: of the result.
            result: of the package.
            brief: without what was measured of its files, classes and functions, which takes most of the room.

        Raises:
            StoreError: the store cannot be written.
        """
        with self._open():
            unit = self._find(key)
            if unit is None:
                try:
                    unit = self._add(key, unit_rows(result, brief=brief))
                except UnicodeEncodeError:
                    self._connection.execute("DELETE FROM unit WHERE key = ?", (key,))
                    unit = self._add(key, unit_rows(encodable(result), brief=brief))
        self._units[unit] = result.package.id

    def add_rows(self, key: str, made: UnitRows) -> None:
        """Keep a package's result, of which another process made the rows, under ``key``.

        Args:
            key: of the result.
            made: the rows.

        Raises:
            StoreError: the store cannot be written.
        """
        with self._open():
            unit = self._find(key)
            if unit is None:
                unit = self._add(key, made)
        self._units[unit] = made.package

    def reuse(self, key: str) -> None:
        """Take the package's result that an earlier run kept under ``key``.

        Raises:
            StoreError: the result is gone, because its run was removed in the meantime.
        """
        with self._open():
            found = self._connection.execute("SELECT id, package FROM unit WHERE key = ?", (key,)).fetchone()
        if found is None:
            raise StoreError(
                f"the result {key!r} is no longer in the store",
                where=str(self._path or "the store in memory"),
                expected="the results of earlier runs to stay while this one is written",
                advice="Run the same command again",
            )
        self._units[found[0]] = found[1]

    def complete(
        self,
        workspace: WorkspaceResult,
        header: RunHeader,
        configurations: Sequence[JudgedConfiguration | PackedConfiguration] = (),
    ) -> int:
        """Make the run visible and return its number.

        Args:
            workspace: what only the packages together show.
            header: what was analysed, when, with what.
            configurations: computation graphs that were looked at.

        Raises:
            StoreError: the store cannot be written; the run is discarded.
        """
        with self._open():
            try:
                run = self._insert_run(workspace, header)
            except UnicodeEncodeError:
                run = self._insert_run(encodable(workspace), encodable(header))
            if configurations:
                from roslens.store.configurations import write_configurations

                write_configurations(self._connection, run, configurations)
            if workspace.process:
                from roslens.store.process import write_process

                write_process(self._connection, run, workspace.process)
            if self._sealed is not None:
                self._sealed.seal(self._connection)
            self._connection.execute("COMMIT")
        if self._sealed is not None:
            self._sealed.written()
        return run

    @contextmanager
    def _open(self) -> Iterator[None]:
        # SQLite ends the transaction itself on some errors; what came after would be visible at once.
        if not self._connection.in_transaction:
            raise StoreError(
                "the run that is being written was discarded after an error",
                where=str(self._path or "the store in memory"),
                expected="no further results for it",
                advice="Run the same command again",
            )
        with as_store_errors(self._path):
            yield

    def _find(self, key: str) -> int | None:
        found = self._connection.execute("SELECT id FROM unit WHERE key = ?", (key,)).fetchone()
        return found[0] if found else None

    def _add(self, key: str, made: UnitRows) -> int:
        unit = _inserted(
            self._connection.execute(
                "INSERT INTO unit (key, package, manifest, summary) VALUES (?, ?, ?, ?)",
                (key, made.package, made.manifest, made.summary),
            )
        )
        self._insert("file", f"position, {rows.FILE}", unit, made.files)
        self._insert("entity", f"position, {rows.ENTITY}", unit, made.entities)
        self._insert("measured", 'kind, quantity, first, "values"', unit, made.measured)
        self._insert_findings(unit, made.findings, made.failures)
        self._insert("set_aside", f"position, {rows.SET_ASIDE}", unit, made.set_aside)
        return unit

    def _insert(self, table: str, columns: str, unit: int, found: Iterable[Row]) -> None:
        marks = ", ".join("?" * (columns.count(",") + 2))
        self._connection.executemany(
            f"INSERT INTO {table} (unit, {columns}) VALUES ({marks})",  # noqa: S608 - names of this package
            ((unit, *row) for row in found),
        )

    def set_aside_by(self) -> frozenset[str]:
        """Return what set findings of the packages aside, as :attr:`roslens.model.set_aside.SetAside.by` has it."""
        with self._open():
            return frozenset(
                row[0]
                for row in self._connection.execute(
                    "SELECT DISTINCT said_by FROM set_aside WHERE unit IN (SELECT value FROM json_each(?))",
                    (rows.to_json(list(self._units)),),
                )
            )

    def function_sums(self, quantity: str) -> dict[str, float]:
        """Return what the functions of each file have of a quantity together, by path, in all packages of the run."""
        sums: dict[str, float] = {}
        with self._open():
            found = self._connection.execute(
                'SELECT unit, first, "values" FROM measured WHERE kind = ? AND quantity = ? '
                "AND unit IN (SELECT value FROM json_each(?))",
                (EntityKind.FUNCTION.value, quantity, rows.to_json(list(self._units))),
            ).fetchall()
            for unit, first, text in found:
                numbers = numbers_of(text)
                paths = self._connection.execute(
                    "SELECT path FROM entity WHERE unit = ? AND position >= ? AND position < ? ORDER BY position",
                    (unit, first, first + len(numbers)),
                )
                for (path,), number in zip(paths, numbers, strict=True):
                    if number is not None:
                        sums[path] = sums.get(path, 0) + number
        return sums

    def _insert_findings(self, unit: int, findings: Iterable[Row], failures: Iterable[Row] = ()) -> None:
        number_of, at = self._tag_sets.number_of, rows.TAGS
        numbered = ((*row[:at], number_of(tuple(row[at])), *row[at + 1 :]) for row in findings)
        self._insert("finding", f"position, {rows.FINDING}", unit, numbered)
        self._insert("failure", f"position, {rows.FAILURE}", unit, failures)

    def _insert_run(self, workspace: WorkspaceResult, header: RunHeader) -> int:
        connection = self._connection
        units = sorted(self._units, key=lambda unit: _package_order(self._units[unit]))
        own, shares = self._insert_workspace(workspace)
        seen = [part for unit in units for part in (unit, shares.get(self._units[unit])) if part is not None]
        counts = _counts(connection, [*seen, own])
        run = _inserted(
            connection.execute(
                f"INSERT INTO run ({rows.RUN}, vocabulary, workspace, packages, files, entities, findings, failures) "  # noqa: S608 - column names of this module
                f"VALUES ({', '.join('?' * 18)})",
                (
                    *rows.run_row(header),
                    self._vocabulary(workspace),
                    own,
                    number_of_packages(self._units.values()),
                    *counts,
                ),
            )
        )
        connection.executemany(
            "INSERT INTO run_unit (run, position, unit) VALUES (?, ?, ?)",
            [(run, position, unit) for position, unit in enumerate((*seen, own))],
        )
        connection.executemany(
            "INSERT INTO package_value (run, package, quantity, value) VALUES (?, ?, ?, ?)",
            [
                (run, package, quantity, value)
                for package, values in workspace.package_values.items()
                for quantity, value in storable_values(values).items()
            ],
        )
        return run

    def _insert_workspace(self, workspace: WorkspaceResult) -> tuple[int, dict[str, int]]:
        """Keep what only the packages together show; return its unit, and by package that of what is of one."""
        known = set(self._units.values())
        findings = list(workspace.findings)
        shares: dict[str, int] = {}
        for package, owned in workspace.package_findings.items():
            if package not in known:
                findings += owned
                continue
            summary = rows.to_json(PackageSummary(package, "", "", rules=rule_counts(owned)))
            shares[package] = _inserted(
                self._connection.execute(
                    "INSERT INTO unit (key, package, summary) VALUES (NULL, ?, ?)", (package, summary)
                )
            )
            self._insert_findings(shares[package], rows_of_findings(owned))
        unit = _inserted(self._connection.execute("INSERT INTO unit (key, package) VALUES (NULL, '')"))
        self._insert_findings(unit, rows_of_findings(findings), rows_of_failures(workspace.failures))
        self._insert("set_aside", f"position, {rows.SET_ASIDE}", unit, rows_of_set_aside(workspace.set_aside))
        return unit, shares

    def _vocabulary(self, workspace: WorkspaceResult) -> int:
        rules, quantities = rows.to_json(workspace.rules), rows.to_json(workspace.quantities)
        digest = blake2b(f"{rules}\0{quantities}".encode(), digest_size=16).hexdigest()
        found = self._connection.execute("SELECT id FROM vocabulary WHERE digest = ?", (digest,)).fetchone()
        if found:
            return int(found[0])
        return _inserted(
            self._connection.execute(
                "INSERT INTO vocabulary (digest, rules, quantities) VALUES (?, ?, ?)", (digest, rules, quantities)
            )
        )


class _TagSets:
    """Numbers for sets of tags, which many findings share."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection
        known = connection.execute("SELECT id, tags FROM tag_set")
        self._numbers = {rows.to_texts(text): number for number, text in known}

    def number_of(self, tags: tuple[str, ...]) -> int:
        number = self._numbers.get(tags)
        if number is None:
            number = _inserted(self._connection.execute("INSERT INTO tag_set (tags) VALUES (?)", (rows.to_json(tags),)))
            self._numbers[tags] = number
        return number


def _inserted(cursor: sqlite3.Cursor) -> int:
    number = cursor.lastrowid
    assert number is not None  # noqa: S101 - only for the type checker: it was an INSERT
    return number


def _counts(connection: sqlite3.Connection, units: Iterable[int]) -> tuple[int, ...]:
    """Return how many files, entities, findings and failures the units have."""
    wanted = rows.to_json(list(units))
    return tuple(
        connection.execute(
            f"SELECT count(*) FROM {table} WHERE unit IN (SELECT value FROM json_each(?))",  # noqa: S608 - names below
            (wanted,),
        ).fetchone()[0]
        for table in ("file", "entity", "finding", "failure")
    )


def _package_order(package: str) -> tuple[bool, str]:
    return (package == OUTSIDE_PACKAGES, package)
