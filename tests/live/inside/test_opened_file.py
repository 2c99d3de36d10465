"""Counter files of others: nothing that their owner does to them ends who reads them."""

import os
import time

import pytest

from roslens.live.inside import slots
from roslens.live.inside.counters import CounterReader
from roslens.live.inside.opened_file import CutOffError, ForeignFile, OpenedFile, open_file
from roslens.live.inside.slots import CounterFile

GID = bytes(range(16))


@pytest.fixture
def writer(tmp_path):
    tmp_path.chmod(0o700)
    made = CounterFile(str(tmp_path), 8)
    made.slot(slots.TAKEN, GID, "/scan", "/planner").arrived(time.time_ns(), time.time_ns(), 1000, None, 10, None)
    yield made
    made.close()


@pytest.fixture
def path(tmp_path, writer):
    (found,) = tmp_path.glob(f"*{slots.SUFFIX}")
    return found


@pytest.fixture
def as_somebody_else(monkeypatch):
    own = os.getuid()
    monkeypatch.setattr(os, "getuid", lambda: own + 1)


def test_only_what_is_ones_own_is_mapped(path):
    own, foreign = open_file(path), open_file(path, os.getuid() + 1)
    assert (type(own), type(foreign)) == (OpenedFile, ForeignFile)
    assert own.tokens() == foreign.tokens() != []
    assert own.slot(0, None) == foreign.slot(0, None) is not None
    assert (own.pid, own.started, own.host) == (foreign.pid, foreign.started, foreign.host)
    assert own.trouble() == foreign.trouble() == ""
    for one in (own, foreign):
        one.close()


@pytest.mark.parametrize("size", [0, 30, slots.HEADER_BYTES, slots.HEADER_BYTES + 100])
def test_a_file_of_somebody_else_that_becomes_shorter_is_told_of(path, size):
    foreign = open_file(path, os.getuid() + 1)
    os.truncate(path, size)
    for read in (lambda: foreign.slot(0, None), lambda: foreign.tokens()):
        with pytest.raises(CutOffError, match="became shorter"):
            read()
    foreign.close()


def test_a_reader_goes_on_without_it(tmp_path, path, as_somebody_else):
    reader = CounterReader(str(tmp_path), tidy=False)
    reader.read(1.0)
    os.truncate(path, 100)
    assert reader.read(2.0) == []
    (failure,) = reader.failures()
    assert (str(path) in failure.what, "became shorter" in failure.what) == (True, True)
    assert reader.read(3.0) == []
    assert reader.failures() == []
    reader.close()


def test_no_size_that_is_claimed_is_believed(path):
    with path.open("r+b") as file:
        file.truncate(1 << 40)
        file.seek(16)
        file.write(b"\xff" * 8)  # capacity and slots in use
    foreign = open_file(path, os.getuid() + 1)
    assert len(foreign.tokens()) == slots.CAPACITY
    foreign.close()


@pytest.mark.parametrize("user", [0, 1])
def test_what_is_no_counter_file_is_refused(tmp_path, user):
    for content in (b"", b"x" * 100, b"x" * 100_000):
        path = tmp_path / "other"
        path.write_bytes(content)
        with pytest.raises(ValueError, match=r"expected|magic"):
            open_file(path, os.getuid() + user)
