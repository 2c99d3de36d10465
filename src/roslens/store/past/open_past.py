"""The file of `roslens watch --history`, opened to be looked at; nothing is written, a watch may go on meanwhile."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roslens.model.errors import StoreError
from roslens.store.connect import Readers, connect
from roslens.store.live.history import SCHEMA, WAIT_S
from roslens.store.live.read_history import read_history
from roslens.store.migrate import migrations
from roslens.store.past.recall import Recall

_ADVICE = "Let `roslens watch --history FILE` of this roslens go on with it once"


@contextmanager
def open_past(path: Path) -> Iterator[Recall]:
    """Lend what reads the history at ``path``.

    Raises:
        StoreError: there is no such file, something else is in it, or another roslens wrote it.
    """
    newest = max(migrations(SCHEMA))
    with read_history(path):
        pass
    connection = connect(path, wait_s=WAIT_S, writable=False)
    readers = Readers(path, connection, WAIT_S)
    try:
        try:
            (version,) = connection.execute("PRAGMA user_version").fetchone()
        except sqlite3.Error as error:
            raise StoreError(f"it cannot be read: {error}", where=str(path), expected="a history") from None
        if version != newest:
            age, advice = ("a newer", "Upgrade roslens") if version > newest else ("an older", _ADVICE)
            raise StoreError(
                f"the history was written by {age} roslens (schema {version})", where=str(path),
                expected=f"schema {newest}", advice=advice,
            )  # fmt: skip
        yield Recall(readers.one, str(path))
    finally:
        readers.close()
        connection.close()
