"""Counter files of others: nothing that their owner does to them ends who reads them."""

import os
import struct
import time

import pytest

from roslens.live.inside import slots
from roslens.live.inside.counter_file import CounterFile
from roslens.live.inside.counters import CounterReader
from roslens.live.inside.opened_file import CutOffError, ForeignFile, OpenedFile, open_file

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


def later(path, *, slot_bytes, version=slots.VERSION + 1):
    """Make of a file what a later version would write: slots are longer, their last word says when they are whole."""
    raw = path.read_bytes()
    header, body = bytearray(raw[: slots.HEADER_BYTES]), raw[slots.HEADER_BYTES :]
    struct.pack_into("=II", header, 8, version, slot_bytes)
    ends = range(0, len(body), slots.SLOT_BYTES)
    more = bytes([0xAB]) * (slot_bytes - slots.SLOT_BYTES)
    longer = [body[at : at + slots.SLOT_BYTES - 8] + more + body[at + slots.SLOT_BYTES - 8 :][:8] for at in ends]
    path.write_bytes(bytes(header) + b"".join(longer))


@pytest.mark.parametrize("user", [0, 1])
@pytest.mark.parametrize("slot_bytes", [slots.SLOT_BYTES, slots.SLOT_BYTES + 8, slots.MOST_SLOT_BYTES])
def test_a_file_of_a_later_version_is_read_as_far_as_it_is_known(path, writer, user, slot_bytes):
    writer.slot(slots.PUBLISHED, b"", "/plan", "/planner")
    old = open_file(path, os.getuid() + user)
    known = [old.slot(number, None) for number in range(2)]
    old.close()
    later(path, slot_bytes=slot_bytes)
    new = open_file(path, os.getuid() + user)
    assert [new.slot(number, None) for number in range(2)] == known
    assert len(new.tokens()) == 2
    new.close()


@pytest.mark.parametrize("user", [0, 1])
@pytest.mark.parametrize(
    ("slot_bytes", "version"),
    [
        (slots.SLOT_BYTES - 8, 2),
        (slots.SLOT_BYTES + 4, 2),
        (slots.MOST_SLOT_BYTES + 8, 2),
        (0, 2),
        (slots.SLOT_BYTES, 0),
    ],
)
def test_a_layout_with_less_or_too_much_is_refused(path, user, slot_bytes, version):
    with path.open("r+b") as file:
        file.seek(8)
        file.write(struct.pack("=II", version, slot_bytes))
    with pytest.raises(ValueError, match=f"version {version}, slots of {slot_bytes} bytes"):
        open_file(path, os.getuid() + user)


def test_traffic_of_a_kind_that_is_not_known_is_left_out_and_told_of_once(tmp_path, writer):
    writer.slot(slots.PUBLISHED, b"", "/plan", "/planner")
    reader = CounterReader(str(tmp_path), tidy=False)
    reader.read(1.0)
    for number, kind in enumerate((slots.KINDS[-1] + 1, 0)):
        slot = writer._slots[number]
        slot._numbers[slots.KIND] = kind
        slot.published(time.time_ns(), 1)
    assert [one for one in reader.read(2.0) if one.tally.count] == []
    assert reader.called() == []
    (failure,) = reader.failures()
    assert "counts traffic of kind 8, which is left out" in failure.what
    reader.close()


@pytest.mark.parametrize("user", [0, 1])
def test_what_is_no_counter_file_is_refused(tmp_path, user):
    for content in (b"", b"x" * 100, b"x" * 100_000):
        path = tmp_path / "other"
        path.write_bytes(content)
        with pytest.raises(ValueError, match=r"expected|magic"):
            open_file(path, os.getuid() + user)
