"""Connections for readers: each has one to itself, and a copy of the process has its own."""

from __future__ import annotations

import os
import sqlite3
import sys
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from roslens.store.connect import Readers, connect, roll_back


@pytest.fixture
def found(tmp_path: Path) -> Iterator[Readers]:
    path = tmp_path / "a.sqlite"
    with closing(connect(path, wait_s=1.0)) as main:
        main.execute("CREATE TABLE numbers (number)")
        main.execute("INSERT INTO numbers VALUES (7)")
        yield Readers(path, main, 1.0)


def test_who_reads_at_the_same_time_has_another_connection(found: Readers) -> None:
    with found.one() as first, found.one() as second:
        assert first is not second
    with found.one() as again:
        assert again in (first, second)
    found.close()
    with pytest.raises(sqlite3.ProgrammingError), found.one():
        pass


@pytest.mark.skipif(sys.platform != "linux", reason="other systems copy no processes")
@pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning")
def test_a_copy_of_the_process_opens_its_own(found: Readers) -> None:
    with found.one() as here:
        pass
    child = os.fork()
    if child == 0:
        with found.one() as there:
            right = there is not here and there.execute("SELECT number FROM numbers").fetchone() == (7,)
        os._exit(0 if right else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    with found.one() as again:
        assert again is here
    found.close()


class Unending(sqlite3.Connection):
    """Whose disk fails while a transaction is ended."""

    def execute(self, words: str, *given: object) -> sqlite3.Cursor:
        if words == "ROLLBACK":
            raise sqlite3.OperationalError("disk I/O error")
        return super().execute(words, *given)  # type: ignore[arg-type]


def test_what_was_not_committed_is_discarded_and_nothing_is_raised_of_it(tmp_path: Path) -> None:
    with closing(connect(tmp_path / "a.sqlite", wait_s=1.0)) as connection:
        roll_back(connection)
        connection.execute("CREATE TABLE numbers (number)")
        connection.execute("BEGIN")
        connection.execute("INSERT INTO numbers VALUES (7)")
        roll_back(connection)
        assert not connection.in_transaction
        assert connection.execute("SELECT * FROM numbers").fetchall() == []
    with closing(sqlite3.connect(tmp_path / "a.sqlite", isolation_level=None, factory=Unending)) as failing:
        failing.execute("BEGIN")
        roll_back(failing)
