"""Files that were packed as a whole, as `ros2 bag record --compression-mode file` and gzip leave them."""

import bz2
import gzip
import os
from importlib import import_module
from pathlib import Path

import pytest

from roslens.live.adapters.bag.damage import FailureLog
from roslens.live.adapters.bag.decompress import RATIO, UNCHECKED
from roslens.live.adapters.bag.files.unpacked_file import KEPT_FREE, unpack
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.model.errors import UsageError

START = 1_700_000_000_000_000_000


def _zstd(content):
    try:
        return import_module("compression.zstd").compress(content)
    except ImportError:
        return import_module("backports.zstd").compress(content)


PACK = {
    "zstd": _zstd,
    "gz": gzip.compress,
    "lz4": lambda content: import_module("lz4.frame").compress(content),
    "bz2": bz2.compress,
}


@pytest.fixture(params=["ros1", "mcap", "sqlite3"])
def whole(request, recording, content_of, tmp_path):
    generation = "ros1" if request.param == "ros1" else "ros2"
    folder = tmp_path / "plain"
    folder.mkdir()
    messages = [("/a", START + number * 10**8, content_of(START, generation)) for number in range(5)]
    return recording(folder, request.param, messages)


@pytest.mark.parametrize("suffix", PACK)
def test_a_packed_file_is_read_as_what_it_was(whole, tmp_path, suffix):
    packed = tmp_path / f"{whole.name}.{suffix}"
    packed.write_bytes(PACK[suffix](whole.read_bytes()))
    bag = open_bag(packed)
    assert (bag.messages, [topic.name for topic in bag.topics]) == (5, ["/a"])
    assert sum(tally.count for _, tallies in bag.tallies() for tally in tallies) == 5
    assert bag.failures == ()


def test_a_folder_of_packed_files_is_read_and_what_was_unpacked_beside_is_read_once(whole, tmp_path):
    folder = tmp_path / "packed"
    folder.mkdir()
    (folder / f"{whole.name}.zstd").write_bytes(PACK["zstd"](whole.read_bytes()))
    assert open_bag(folder).messages == 5
    (folder / whole.name).write_bytes(whole.read_bytes())
    assert open_bag(folder).messages == 5


def test_what_was_unpacked_is_removed_with_the_recording(tmp_path):
    packed = tmp_path / "a.mcap.gz"
    packed.write_bytes(gzip.compress(b"content"))
    unpacked = unpack(packed, FailureLog())
    path = unpacked.path
    assert (path.name, path.read_bytes()) == ("a.mcap", b"content")
    del unpacked
    assert not path.exists()


def test_of_a_file_that_is_cut_off_the_rest_is_read_and_that_is_told(tmp_path):
    content = os.urandom(3_000_000)
    packed = tmp_path / "a.mcap.gz"
    packed.write_bytes(gzip.compress(content)[:2_000_000])
    failures = FailureLog()
    unpacked = unpack(packed, failures)
    assert 0 < unpacked.path.stat().st_size < 3_000_000
    assert content.startswith(unpacked.path.read_bytes())
    assert "cannot be unpacked to its end" in failures.all()[0].what


@pytest.mark.parametrize("magic", [b"\x28\xb5\x2f\xfd", b"\x1f\x8b\x08\x00", b"\x04\x22\x4d\x18", b"BZh9"])
def test_a_file_of_which_nothing_can_be_unpacked_is_refused(tmp_path, magic):
    packed = tmp_path / "a.mcap.zstd"
    packed.write_bytes(magic + b"garbage" * 3)
    with pytest.raises(UsageError, match="cannot be unpacked"):
        open_bag(packed)


def test_a_file_that_claims_to_be_huge_is_refused(tmp_path):
    packed = tmp_path / "a.mcap.zstd"
    packed.write_bytes(_zstd(bytes(UNCHECKED + RATIO * 10_000)))
    assert packed.stat().st_size < 10_000
    with pytest.raises(UsageError, match="more than 1,000 times its size"):
        unpack(packed, FailureLog())


def test_where_there_is_no_room_that_is_said(tmp_path):
    packed = tmp_path / "a.mcap.gz"
    packed.write_bytes(gzip.compress(bytes(5_000)))
    with pytest.raises(UsageError) as caught:
        unpack(packed, FailureLog(), lambda _: KEPT_FREE + 1_000)
    assert "room" in str(caught.value)
    assert "$TMPDIR" in caught.value.advice


def test_what_is_not_packed_is_left_alone(tmp_path):
    path = Path(tmp_path / "a.mcap")
    path.write_bytes(b"\x89MCAP0\r\n")
    assert unpack(path, FailureLog()) is None
