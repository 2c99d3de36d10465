"""Only plain files, and no more of them than was asked for."""

import errno
import os
from pathlib import Path

import pytest

from roslens.cli.workplace.configuration import find_configuration
from roslens.intake.bounded_file import TooLargeError, read_bounded
from roslens.model.errors import DocumentError


def test_a_file_that_fits(tmp_path):
    (tmp_path / "a").write_bytes(b"12345")
    assert read_bounded(tmp_path / "a", 5) == b"12345"
    with pytest.raises(TooLargeError, match="5 bytes; at most 4 are read"):
        read_bounded(tmp_path / "a", 4)


def test_a_sparse_file_takes_no_memory(tmp_path):
    with (tmp_path / "a").open("wb") as stream:
        stream.truncate(3 << 30)
    with pytest.raises(TooLargeError):
        read_bounded(tmp_path / "a", 1 << 20)


def test_pipes_devices_and_folders_are_no_plain_files(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", tmp_path, Path("/dev/zero")):
        with pytest.raises(OSError, match=r"no plain file|directory"):
            read_bounded(path, 10)


def test_what_says_it_is_empty_is_read_no_further(tmp_path):
    with pytest.raises(TooLargeError):
        read_bounded(Path("/proc/self/maps"), 10)


def test_a_configuration_of_three_gigabytes(tmp_path):
    for name in ("pyproject.toml", "roslens.toml"):
        with (tmp_path / name).open("wb") as stream:
            stream.truncate(3 << 30)
    with pytest.raises(DocumentError, match="a file of 3,221,225,472 bytes"):
        find_configuration(tmp_path, None)
    (tmp_path / "roslens.toml").unlink()
    (tmp_path / ".git").mkdir()
    assert find_configuration(tmp_path, None).path == ""


def test_a_file_that_fails_while_it_is_read_is_named(tmp_path, monkeypatch):
    file = tmp_path / "a"
    file.write_bytes(b"x")

    def failing(*_):
        raise BlockingIOError(errno.EAGAIN, "nothing to say yet")

    monkeypatch.setattr(os, "read", failing)
    with pytest.raises(OSError, match="nothing to say yet") as failed:
        read_bounded(file)
    assert (failed.value.errno, failed.value.filename) == (errno.EAGAIN, str(file))
