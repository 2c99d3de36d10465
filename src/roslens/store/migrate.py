"""Numbered migrations: ``NNNN_name.sql`` files, each applied once, in order, all of it or nothing.

The number of the last one is the store's ``user_version``.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from pathlib import Path

from roslens.model.errors import StoreError
from roslens.store.connect import roll_back, write_ahead

SCHEMA = Path(__file__).with_name("schema")
APPLICATION_ID = 0x726F736C
"""``rosl``; marks the file as a store, so that no other program's database is ever changed."""


def migrate(connection: sqlite3.Connection, path: Path | None, schema: Path = SCHEMA) -> None:
    """Bring the store behind ``connection`` to the newest schema; a store that has it costs two look-ups.

    Args:
        connection: in autocommit mode.
        path: of the file, for messages; None for a store in memory.
        schema: the folder of the migrations.

    Raises:
        StoreError: the file belongs to another program, or a newer roslens wrote it.
        sqlite3.Error: a migration failed; the store is as it was before.
    """
    steps = migrations(schema)
    newest = max(steps)
    # In one transaction: between two look-ups another process may make the store.
    connection.execute("BEGIN")
    try:
        version = _checked_version(connection, path, newest)
    finally:
        roll_back(connection)
    if version == newest:
        return
    if version == 0 and path is not None:
        write_ahead(connection)
    for number in range(version + 1, newest + 1):
        connection.execute("BEGIN IMMEDIATE")
        try:
            # Another process may have done it while this one waited for the lock.
            if _checked_version(connection, path, newest) < number:
                for statement in statements(steps[number].read_text("utf-8")):
                    connection.execute(statement)
                connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
                connection.execute(f"PRAGMA user_version = {number}")
            connection.execute("COMMIT")
        except BaseException:
            roll_back(connection)
            raise


def migrations(schema: Path) -> dict[int, Path]:
    """Return the migrations by their number."""
    return {int(file.name[:4]): file for file in schema.glob("[0-9][0-9][0-9][0-9]_*.sql")}


def _checked_version(connection: sqlite3.Connection, path: Path | None, newest: int) -> int:
    version = int(connection.execute("PRAGMA user_version").fetchone()[0])
    application = connection.execute("PRAGMA application_id").fetchone()[0]
    where = str(path) if path else "the store in memory"
    if application != APPLICATION_ID:
        tables = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
        if version or application or tables:
            raise StoreError(
                "the database was made by another program",
                where=where,
                expected="a store written by roslens",
                advice="Move the file away; `roslens check` makes a new one",
            )
    elif version > newest:
        raise StoreError(
            f"the store was written by a newer roslens (schema {version})",
            where=where,
            expected=f"schema {newest} or older",
            advice="Upgrade roslens, or move the file away; `roslens check` makes a new one",
        )
    return version


def statements(script: str) -> Iterator[str]:
    """Yield the statements of a migration."""
    statement = ""
    for line in script.splitlines(keepends=True):
        statement += line
        if sqlite3.complete_statement(statement):
            yield statement
            statement = ""
