"""Digests of what a store holds, under one code that only the key of its user and folder makes.

Each row that has a number (a run, a unit, a vocabulary …) is digested with the rows that belong to it; the code
(HMAC-SHA256) is of all these digests and of the schema. All of it is written in the transaction that changes the store:
a process that is killed leaves either the store before it or the one after.
"""

from __future__ import annotations

import hmac
import sqlite3
from collections.abc import Iterable, Iterator
from hashlib import blake2b
from typing import NamedTuple

import msgspec

_TABLE = "seal"
_HEAD = "head"
_OWNERS = ("run", "unit")
"""Columns that say to which numbered row a row belongs."""
_VOLATILE = frozenset({"writer", _TABLE})
"""Tables that hold nothing of a result."""

_encode = msgspec.msgpack.Encoder().encode


class _Table(NamedTuple):
    """A numbered table, and the tables whose rows belong to its rows."""

    name: str
    parts: tuple[tuple[str, str], ...]


def is_sealed(connection: sqlite3.Connection) -> bool:
    """Return whether the store has seals at all.

    Raises:
        sqlite3.Error: it cannot be read.
    """
    found = connection.execute("SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ?", (_TABLE,))
    return bool(found.fetchone()[0])


def is_empty(connection: sqlite3.Connection) -> bool:
    """Return whether the store holds nothing yet.

    Raises:
        sqlite3.Error: it cannot be read.
    """
    return not any(_numbers(connection, table.name) for table in _tables(connection))


def is_as_sealed(connection: sqlite3.Connection, key: bytes) -> bool:
    """Return whether everything in the store is as it was sealed with the key; reads all of it.

    Indexes count as well: a question that is answered by one must find what the table holds.

    Raises:
        sqlite3.Error: it cannot be read.
    """
    kept = dict(_kept(connection))
    code = kept.pop((_HEAD, 0), b"")
    if not hmac.compare_digest(code, _code(connection, kept.items(), key)):
        return False
    tables = _tables(connection)
    numbers = {(table.name, number) for table in tables for number in _numbers(connection, table.name)}
    if numbers != kept.keys():
        return False
    if connection.execute("PRAGMA integrity_check(1)").fetchone()[0] != "ok":
        return False
    return all(
        kept[table.name, number] == _digest(connection, table, number)
        for table in tables
        for number in _numbers(connection, table.name)
    )


def seal(connection: sqlite3.Connection, key: bytes, *, anew: Iterable[tuple[str, int]] = ()) -> None:
    """Seal what was added since the last time, and let go of what is gone; within the transaction that changed it.

    Args:
        connection: of the store.
        key: of its user and folder.
        anew: tables and numbers of rows that were sealed before and changed since.

    Raises:
        sqlite3.Error: the store cannot be written.
    """
    connection.execute(
        f"CREATE TABLE IF NOT EXISTS {_TABLE} (kind TEXT, number INTEGER, digest BLOB NOT NULL, "
        "PRIMARY KEY (kind, number)) WITHOUT ROWID"
    )
    connection.executemany(f"DELETE FROM {_TABLE} WHERE kind = ? AND number = ?", list(anew))  # noqa: S608 - a name of this module
    kept = dict(_kept(connection))
    kept.pop((_HEAD, 0), None)
    for table in _tables(connection):
        numbers = set(_numbers(connection, table.name))
        known = {number for kind, number in kept if kind == table.name}
        for number in known - numbers:
            del kept[table.name, number]
        kept |= {(table.name, number): _digest(connection, table, number) for number in numbers - known}
    rows = [(kind, number, digest) for (kind, number), digest in kept.items()]
    before = dict(_kept(connection))
    gone = [place for place in before if place not in kept]
    connection.executemany(f"DELETE FROM {_TABLE} WHERE kind = ? AND number = ?", gone)  # noqa: S608 - a name of this module
    new = [row for row in rows if before.get((row[0], row[1])) != row[2]]
    new.append((_HEAD, 0, _code(connection, kept.items(), key)))
    connection.executemany(f"INSERT OR REPLACE INTO {_TABLE} (kind, number, digest) VALUES (?, ?, ?)", new)  # noqa: S608 - a name of this module


def seal_all(connection: sqlite3.Connection, key: bytes) -> None:
    """Seal everything as it is now.

    Raises:
        sqlite3.Error: the store cannot be written.
    """
    if is_sealed(connection):
        connection.execute(f"DELETE FROM {_TABLE}")  # noqa: S608 - a name of this module
    seal(connection, key)


def _kept(connection: sqlite3.Connection) -> Iterator[tuple[tuple[str, int], bytes]]:
    for kind, number, digest in connection.execute(f"SELECT kind, number, digest FROM {_TABLE}"):  # noqa: S608 - a name of this module
        yield (kind, number), digest


def _code(connection: sqlite3.Connection, digests: Iterable[tuple[tuple[str, int], bytes]], key: bytes) -> bytes:
    """Return the code of the digests, and of how the database is made: a view or trigger can show something else."""
    made = connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master ORDER BY type, name").fetchall()
    marks = [connection.execute(f"PRAGMA {name}").fetchone() for name in ("application_id", "user_version")]
    return hmac.digest(key, _encode((made, marks, sorted(digests))), "sha256")


def _digest(connection: sqlite3.Connection, table: _Table, number: int) -> bytes:
    """Return the digest of a row with the rows that belong to it."""
    digest = blake2b(digest_size=32)
    own = connection.execute(f'SELECT * FROM "{table.name}" WHERE id = ?', (number,))  # noqa: S608 - a name of the schema
    digest.update(_encode(own.fetchall()))
    for part, owner in table.parts:
        found = connection.execute(f'SELECT * FROM "{part}" WHERE "{owner}" = ? ORDER BY 1, 2, 3', (number,))  # noqa: S608 - names of the schema
        digest.update(_encode((part, found.fetchall())))
    return digest.digest()


def _numbers(connection: sqlite3.Connection, table: str) -> list[int]:
    return [number for (number,) in connection.execute(f'SELECT id FROM "{table}"')]  # noqa: S608 - a name of the schema


def _tables(connection: sqlite3.Connection) -> list[_Table]:
    """Return the numbered tables of the store's schema, each with those whose rows belong to its rows."""
    names = connection.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name").fetchall()
    columns = {
        name: [column for (column,) in connection.execute("SELECT name FROM pragma_table_info(?)", (name,))]
        for (name,) in names
        if name not in _VOLATILE
    }
    owner = {name: next((one for one in _OWNERS if one in found), "") for name, found in columns.items()}
    return [
        _Table(name, tuple((part, owned) for part, owned in owner.items() if owned == name))
        for name, found in columns.items()
        if "id" in found and not owner[name]
    ]
