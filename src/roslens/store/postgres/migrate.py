"""The schema of a shared store: the migrations of the store itself, translated."""

from __future__ import annotations

from pathlib import Path

from roslens.model.errors import StoreError
from roslens.store.connect import roll_back
from roslens.store.migrate import SCHEMA, migrations, statements
from roslens.store.postgres.connection import SharedConnection
from roslens.store.postgres.dialect import definitions

LOCK = 0x726F736C
"""``rosl``: who holds the advisory lock of this number and of the schema changes tables, or writes a run."""


def migrate_shared(connection: SharedConnection, where: str, schema: Path = SCHEMA) -> None:
    """Bring a shared store to the newest schema.

    Raises:
        StoreError: a newer roslens wrote it.
        sqlite3.Error: a migration failed; the store is as it was before.
    """
    steps = migrations(schema)
    newest = max(steps)
    connection.execute("BEGIN")
    try:
        connection.execute(f"SELECT pg_advisory_xact_lock({LOCK}, hashtext(current_schema()))")
        connection.execute("CREATE TABLE IF NOT EXISTS schema_version (number BIGINT NOT NULL)")
        version = connection.execute("SELECT coalesce(max(number), 0) FROM schema_version").fetchone()[0]
        _refuse_newer(version, newest, where)
        for number in range(version + 1, newest + 1):
            for statement in definitions(statements(steps[number].read_text("utf-8"))):
                connection.execute(statement)
            connection.execute("INSERT INTO schema_version (number) VALUES (?)", (number,))
        connection.execute("COMMIT")
    except BaseException:
        roll_back(connection)
        raise


def _refuse_newer(version: int, newest: int, where: str) -> None:
    if version > newest:
        raise StoreError(
            f"the store was written by a newer roslens (schema {version})",
            where=where,
            expected=f"schema {newest} or older",
            advice="Upgrade roslens, or give another ?schema=NAME",
        )
