"""From errors of SQLite to advice for the user."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roslens.model.errors import StoreError
from roslens.store.file_size_limit import file_size_limit
from roslens.store.full_disk import full_file_system

SERVER = "database server"
"""The advice of every error of a shared store's server."""

_ADVICE = (
    (
        SERVER,
        "the shared store cannot be used",
        "a server that answers, and a database that may be written",
        "Run the same command again: what was learned of files is kept on this machine; or run with --no-store",
    ),
    # (what SQLite's message contains, what was found, what was expected, what to do next)
    (
        "disk is full",
        "the disk is full",
        "room for the results of the run",
        "Free some space, or run with --no-store; earlier runs are still there",
    ),
    ("locked", "the store is in use by another process", "the store to be free", "Wait until it is finished"),
    (
        "not a database",
        "the file is not a SQLite database",
        "a store written by roslens",
        "Move the file away; `roslens check` makes a new one",
    ),
    (
        "malformed",
        "the store is damaged",
        "a complete SQLite database",
        "Move the file away; `roslens check` makes a new one",
    ),
    (
        "disk I/O error",
        "the disk failed",
        "a disk that can be read and written",
        "Check the disk; if the file is damaged, move it away and `roslens check` makes a new one",
    ),
    (
        "readonly",
        "the store cannot be written",
        "a file and a folder that may be written",
        "Check their permissions, or run with --no-store",
    ),
    (
        "unable to open",
        "the store cannot be opened",
        "a file in a folder that may be read and written",
        "Check the permissions of the folder, or run with --no-store",
    ),
)

_PERHAPS_FULL = ("disk is full", "disk I/O error", "unable to open")
"""The errors of SQLite for a full disk: for the file itself, or for what it writes beside it."""


def store_error(path: Path | str | None, error: Exception) -> StoreError | None:
    """Return the error in the message form; None for one that only a bug of roslens explains."""
    where = str(path) if path else "the store in memory"
    if isinstance(error, OSError):
        return StoreError(
            f"the store cannot be used ({error.strerror or str(error)!r})",
            where=where,
            expected="a folder with room that may be read and written",
            advice="Check its permissions, or run with --no-store",
        )
    text = str(error)
    if any(said in text for said in _PERHAPS_FULL) and path and (most := file_size_limit(Path(path))):
        return StoreError(
            f"a file may have at most {most:,} bytes here ({text!r})",
            where=where,
            expected="room for the results of the run",
            advice="Raise the limit (`ulimit -f`), or run with --no-store; earlier runs are still there",
        )
    if (
        SERVER not in text
        and any(said in text for said in _PERHAPS_FULL)
        and (full := full_file_system((Path(path),) if path else ()))
    ):
        return StoreError(
            f"the file system is full: {full} ({text!r})",
            where=where,
            expected="room for the results of the run",
            advice="Free some space there, or run with --no-store; earlier runs are still there",
        )
    for said, what, expected, advice in _ADVICE:
        if said in text:
            return StoreError(f"{what} ({text!r})", where=where, expected=expected, advice=advice)
    return None


@contextmanager
def as_store_errors(path: Path | str | None) -> Iterator[None]:
    """Turn errors of SQLite inside the block into errors with advice.

    Raises:
        StoreError: SQLite failed for a reason that a user can do something about.
    """
    try:
        yield
    except (sqlite3.Error, OSError) as error:
        known = store_error(path, error)
        if known is None:
            raise
        raise known from error
