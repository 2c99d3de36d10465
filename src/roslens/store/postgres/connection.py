"""A connection to PostgreSQL that looks to the store as one of SQLite does."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from roslens.model.errors import StoreError, UsageError
from roslens.store.postgres.dialect import translated
from roslens.store.sqlite_errors import SERVER


class SharedConnection(sqlite3.Connection):
    """Statements of the store, run by a server.

    It is a connection of SQLite in name, so that the store needs no second set of signatures; its own database, in
    memory, is never used. Errors of the server are raised as those of SQLite,
    with :data:`~roslens.store.sqlite_errors.SERVER` in their text.
    """

    server: Any

    def execute(self, statement: str, values: Any = (), /) -> Any:
        """Run a statement and return its rows.

        Raises:
            sqlite3.Error: the server refused it, or is gone.
        """
        with _as_sqlite_errors():
            cursor = self.server.cursor()
            cursor.execute(translated(statement), _plain(values))
            return _Rows(cursor)

    def executemany(self, statement: str, rows: Iterable[Any], /) -> Any:
        """Run a statement once for each row.

        Raises:
            sqlite3.Error: the server refused one, or is gone.
        """
        # The rows may need statements of their own, which must not come between.
        ready = [_plain(row) for row in rows]
        with _as_sqlite_errors():
            cursor = self.server.cursor()
            if ready:
                cursor.executemany(translated(statement).removesuffix(" RETURNING id"), ready)
            return cursor

    @property
    def in_transaction(self) -> bool:
        """Whether a transaction was begun and not ended."""
        return not self.server.closed and self.server.info.transaction_status.name in ("INTRANS", "INERROR", "ACTIVE")

    def close(self) -> None:
        """End the connection."""
        with _as_sqlite_errors():
            self.server.close()
        super().close()


class _Rows:
    """The rows of a statement, as a cursor of SQLite gives them."""

    def __init__(self, cursor: Any) -> None:
        self._cursor = cursor

    def __iter__(self) -> Iterator[tuple[Any, ...]]:
        with _as_sqlite_errors():
            return iter(self._cursor.fetchall() if self._cursor.description else ())

    def fetchone(self) -> tuple[Any, ...] | None:
        """Return the next row; None behind the last."""
        with _as_sqlite_errors():
            row: tuple[Any, ...] | None = self._cursor.fetchone()
            return row

    def fetchall(self) -> list[tuple[Any, ...]]:
        """Return all rows that are left."""
        return list(self)

    @property
    def lastrowid(self) -> int | None:
        """The number that an INSERT gave."""
        row = self.fetchone()
        return int(row[0]) if row else None

    @property
    def rowcount(self) -> int:
        """How many rows were changed."""
        return int(self._cursor.rowcount)


def connect_shared(address: str, *, wait_s: float) -> SharedConnection:
    """Connect to the database and the schema that an address names, which is made if it is missing.

    Statements commit on their own unless a transaction was begun.

    Args:
        address: ``postgresql://…``; ``?schema=NAME`` names the schema, ``roslens`` without one.
        wait_s: seconds within which the server has to answer.

    Raises:
        UsageError: psycopg is not installed, or the address is none.
        StoreError: the server does not let in.
    """
    _, schema = divided(address)
    with _let_in(address, wait_s) as server:
        server.execute("SET client_min_messages = warning")
        server.execute(f'CREATE SCHEMA IF NOT EXISTS "{schema}"')
        server.execute(f'SET search_path TO "{schema}"')
    connection = SharedConnection(":memory:", isolation_level=None, check_same_thread=False)
    connection.server = server
    return connection


def has_schema(address: str, *, wait_s: float = 10.0) -> bool:
    """Return whether the schema that an address names is there; nothing is made.

    Raises:
        UsageError: psycopg is not installed, or the address is none.
        StoreError: the server does not let in.
    """
    _, schema = divided(address)
    with _let_in(address, wait_s) as server, server:
        found = server.execute("SELECT 1 FROM pg_namespace WHERE nspname = %s", (schema,)).fetchone()
    return found is not None


@contextmanager
def _let_in(address: str, wait_s: float) -> Iterator[Any]:
    try:
        import psycopg
    except ImportError as error:
        raise UsageError(
            "psycopg, which speaks to PostgreSQL, is not installed",
            expected="roslens[postgres]",
            advice="Install it with `pip install 'roslens[postgres]'`",
        ) from error
    plain, _ = divided(address)
    try:
        yield psycopg.connect(plain, autocommit=True, connect_timeout=max(2, int(wait_s)))
    except psycopg.Error as error:
        raise StoreError(
            f"the {SERVER} does not let in: {' '.join(str(error).split())[:300]}",
            where=shown(address),
            expected="a database that may be written",
            advice="Check host, user and database; a password is best kept in ~/.pgpass",
        ) from error


def with_schema(address: str, more: str) -> str:
    """Return an address whose schema has a longer name.

    Raises:
        UsageError: that is no name of a schema.
    """
    from urllib.parse import parse_qsl, urlencode, urlsplit

    plain, schema = divided(address)
    parts = urlsplit(plain)
    longer = parts._replace(query=urlencode([*parse_qsl(parts.query), ("schema", schema + more)])).geturl()
    divided(longer)
    return longer


def divided(address: str) -> tuple[str, str]:
    """Return an address without its schema, and the schema.

    Raises:
        UsageError: the schema is no plain name.
    """
    import re
    from urllib.parse import parse_qsl, urlencode, urlsplit

    parts = urlsplit(address)
    query = parse_qsl(parts.query)
    schema = next((value for key, value in query if key == "schema"), "roslens")
    if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]{0,62}", schema):
        raise UsageError(f"the schema {schema!r}", expected="letters, digits and _, a letter first")
    rest = urlencode([(key, value) for key, value in query if key != "schema"])
    return parts._replace(query=rest).geturl(), schema


def shown(address: str) -> str:
    """Return an address without its password."""
    from urllib.parse import urlsplit

    parts = urlsplit(address)
    if parts.password is None:
        return address
    return parts._replace(netloc=parts.netloc.replace(f":{parts.password}@", "@", 1)).geturl()


def _plain(values: Sequence[Any]) -> list[Any]:
    """Return values that PostgreSQL takes: it has no zero byte in texts, and a truth is no number."""
    return [
        int(one)
        if isinstance(one, bool)
        else one.replace("\0", "\N{REPLACEMENT CHARACTER}")
        if isinstance(one, str)
        else one
        for one in values
    ]


@contextmanager
def _as_sqlite_errors() -> Iterator[None]:
    import psycopg

    try:
        yield
    except psycopg.Error as error:
        text = " ".join(str(error).split())[:300]
        if isinstance(error, (psycopg.OperationalError, psycopg.InterfaceError, psycopg.errors.InsufficientPrivilege)):
            raise sqlite3.OperationalError(f"{SERVER}: {text}") from error
        raise sqlite3.ProgrammingError(text) from error
