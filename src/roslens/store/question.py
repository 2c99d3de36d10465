"""One question to a run: its conditions as SQL with bound values, and the rows that answer it."""

from __future__ import annotations

import sqlite3
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

from roslens.model.tags import TagFilter
from roslens.store.connect import Readers
from roslens.store.rows import Row
from roslens.store.sqlite_errors import as_store_errors


class Conditions:
    """Conditions on the units of a run and one table of theirs.

    ``values`` belong to the marks in :attr:`text`.
    """

    def __init__(self) -> None:
        """Start without any condition."""
        self._conditions: list[str] = []
        self.values: list[object] = []

    @property
    def text(self) -> str:
        """All conditions, each behind an ``AND``."""
        return "".join(f" AND {condition}" for condition in self._conditions)

    def equal(self, column: str, value: str | int | None) -> None:
        """Ask for rows whose column is ``value``; None asks for nothing."""
        if value is not None:
            self._conditions.append(f"{column} = ?")
            self.values.append(value)

    def one_of(self, column: str, values: Collection[str]) -> None:
        """Ask for rows whose column is among ``values``."""
        self._conditions.append(f"{column} IN ({', '.join('?' * len(values))})")
        self.values.extend(values)

    def package(self, package: str | None) -> None:
        """Ask for what is of the package with this id; None asks for nothing."""
        if package is not None:
            self._conditions.append("run_unit.unit IN (SELECT id FROM unit WHERE package = ?)")
            self.values.append(package)

    def tags(self, wanted: TagFilter, known: dict[int, tuple[str, ...]]) -> None:
        """Ask for findings with tags that ``wanted`` matches; ``known`` holds all sets of tags by number."""
        if wanted:
            numbers = [str(number) for number, tags in known.items() if wanted.matches(tags)]
            self._conditions.append(f"finding.tag_set IN ({', '.join(numbers)})")


class Run:
    """The rows of one complete run."""

    def __init__(self, readers: Readers, path: Path | str | None, number: int) -> None:
        """``path`` is that of the store, for messages."""
        self._readers = readers
        self._path = path
        self.number = number

    def wait_at_most(self, seconds: float) -> None:
        """Read no longer than so many seconds after another process locked the store; then it cannot be read."""
        self._readers.wait_at_most(seconds)

    @contextmanager
    def reading(self) -> Iterator[sqlite3.Connection]:
        """Lend a connection to read with.

        Raises:
            StoreError: the store cannot be read.
        """
        with as_store_errors(self._path), self._readers.one() as connection:
            yield connection

    def rows(
        self,
        columns: str,
        table: str,
        where: Conditions,
        *,
        unit: bool = False,
        order: str = "position",
        limit: int | None = None,
        offset: int = 0,
        first: str = "",
    ) -> Iterator[Row]:
        """Yield rows of the table in the order of the run's units, then of ``order`` (empty: in any order).

        Args:
            columns: to select; of ``run_unit``, the table and, with ``unit``, of ``unit``.
            table: one that has a column ``unit``.
            where: the conditions.
            unit: whether columns of ``unit`` are selected.
            order: a column of the table.
            limit: at most so many rows.
            offset: without the first so many.
            first: an expression of this package that decides before that order.

        Raises:
            StoreError: the store cannot be read.
        """
        # CROSS JOIN keeps the order of the tables: one seek per unit, and rows come out sorted.
        join = "CROSS JOIN unit ON unit.id = run_unit.unit " if unit else ""
        before = f"{first}, " if first else ""
        sort = f" ORDER BY {before}run_unit.position, {table}.{order}" if order else ""
        cut = (
            f" LIMIT {-1 if limit is None else int(limit)} OFFSET {int(offset)}" if limit is not None or offset else ""
        )
        query = (
            f"SELECT {columns} FROM run_unit {join}CROSS JOIN {table} ON {table}.unit = run_unit.unit "  # noqa: S608 - names of this package; values are bound
            f"WHERE run_unit.run = ?{where.text}{sort}{cut}"
        )
        with self.reading() as connection:
            yield from connection.execute(query, (self.number, *where.values))
