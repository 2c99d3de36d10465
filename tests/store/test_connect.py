"""Connections for readers: each has one to itself, and a copy of the process has its own."""

from __future__ import annotations

import os
import sqlite3
import sys
from pathlib import Path

import pytest

from roslens.store.connect import Readers, connect


def readers(path: Path) -> Readers:
    main = connect(path, wait_s=1.0)
    main.execute("CREATE TABLE numbers (number)")
    main.execute("INSERT INTO numbers VALUES (7)")
    return Readers(path, main, 1.0)


def test_who_reads_at_the_same_time_has_another_connection(tmp_path: Path) -> None:
    found = readers(tmp_path / "a.sqlite")
    with found.one() as first, found.one() as second:
        assert first is not second
    with found.one() as again:
        assert again in (first, second)
    found.close()
    with pytest.raises(sqlite3.ProgrammingError), found.one():
        pass


@pytest.mark.skipif(sys.platform != "linux", reason="other systems copy no processes")
@pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning")
def test_a_copy_of_the_process_opens_its_own(tmp_path: Path) -> None:
    found = readers(tmp_path / "a.sqlite")
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
