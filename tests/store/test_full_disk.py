"""The message names the file system that is full, wherever the error came from."""

import errno
import os
import sqlite3
from types import SimpleNamespace

import pytest

from roslens.cli.terminal.boundary import BAD_INPUT, guarded
from roslens.store.full_disk import full_file_system
from roslens.store.sqlite_errors import store_error

ROOM = SimpleNamespace(f_blocks=100, f_bavail=10**6, f_frsize=4096, f_files=10, f_favail=5)
FULL = SimpleNamespace(f_blocks=100, f_bavail=3, f_frsize=4096, f_files=10, f_favail=5)
NO_NAMES = SimpleNamespace(f_blocks=100, f_bavail=10**6, f_frsize=4096, f_files=10, f_favail=0)


@pytest.fixture
def full(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "statvfs", lambda place: FULL if str(place).startswith(str(tmp_path)) else ROOM)
    return tmp_path


def test_the_first_that_is_full(full, monkeypatch):
    assert full_file_system([full / "not" / "there"]) == "/ (12,288 bytes are free)"
    assert full_file_system(["/proc"]) == ""
    monkeypatch.setattr(os, "statvfs", lambda _place: NO_NAMES)
    assert full_file_system([]) == "/ (it takes no more files)"


@pytest.mark.parametrize("said", ["database or disk is full", "disk I/O error", "unable to open database file"])
def test_a_store_on_it(full, said):
    error = store_error(full / "store.sqlite", sqlite3.OperationalError(said))
    assert "the file system is full: / (12,288 bytes are free)" in str(error)
    assert "Free some space there" in str(error)
    assert "ove the file away" not in str(error)


def test_a_store_elsewhere(monkeypatch, tmp_path):
    monkeypatch.setattr(os, "statvfs", lambda _place: ROOM)
    assert "Check the disk" in str(store_error(tmp_path / "s", sqlite3.OperationalError("disk I/O error")))


def test_any_other_file(full, capsys):
    def command() -> int:
        raise OSError(errno.ENOSPC, "No space left on device", str(full / "report.json"))

    assert guarded(command, []) == BAD_INPUT
    said = capsys.readouterr().err
    assert "report.json: the file system is full: / (12,288 bytes are free). Free some space there" in said
