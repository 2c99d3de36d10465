import bz2
import sys

import lz4.frame
import pytest

import roslens.live.adapters.bag.decompress as decompress_module
from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.decompress import LARGEST, RATIO, UNCHECKED, decompress, most_unpacked, unpack_start

if sys.version_info >= (3, 14):
    from compression import zstd
else:
    from backports import zstd

PACK = {"bz2": bz2.compress, "lz4": lz4.frame.compress, "zstd": zstd.compress, "": bytes, "none": bytes}
TEXT = b"".join(number.to_bytes(4, "little") for number in range(50_000))


@pytest.mark.parametrize("way", PACK)
def test_what_was_packed_comes_back(way):
    assert decompress(PACK[way](TEXT), way, len(TEXT)) == TEXT


@pytest.mark.parametrize("way", ["bz2", "lz4", "zstd"])
def test_several_frames_are_one_content_and_a_cut_one_gives_its_start(way):
    packed = PACK[way](TEXT) + PACK[way](b"end")
    assert decompress(packed, way, len(TEXT) + 3) == TEXT + b"end"
    found, _ = unpack_start(packed[: len(packed) // 2], way, len(TEXT))
    assert TEXT.startswith(found)


@pytest.mark.parametrize(
    ("content", "way", "size"),
    [
        (b"garbage", "zstd", 5),
        (b"garbage", "lz4", 5),
        (b"garbage", "bz2", 5),
        (b"x", "lz4", 10**9),
        (b"x", "zstd", LARGEST + 1),
        (b"x", "rar", 1),
        (TEXT, "", 3),
        (zstd.compress(TEXT), "zstd", len(TEXT) + 1),
    ],
)
def test_what_lies_about_itself_is_damaged(content, way, size):
    with pytest.raises(DamageError):
        decompress(content, way, size)


def test_nothing_is_unpacked_beyond_the_size_it_claims():
    found, _ = unpack_start(zstd.compress(bytes(10_000_000)), "zstd", 1000)
    assert len(found) == 1000


@pytest.mark.parametrize("way", ["bz2", "zstd", "lz4"])
def test_a_bomb_is_refused_before_it_is_unpacked(way, monkeypatch):
    monkeypatch.setattr(decompress_module, "_unpackers", lambda: pytest.fail("unpacked"))
    assert LARGEST == 256_000_000
    for packed, size in ((722, LARGEST), (UNCHECKED // RATIO, UNCHECKED + 1), (10**9, LARGEST + 1)):
        found, reason = unpack_start(bytes(packed) if packed < 10**6 else _Long(), way, size)
        assert found == b""
        assert f"{size:,}" in reason


class _Long(bytes):
    def __len__(self) -> int:
        return 10**9


def test_what_is_packed_well_is_no_bomb():
    black = bytes(UNCHECKED)
    assert decompress(zstd.compress(black), "zstd", len(black)) == black
    assert most_unpacked(100) == UNCHECKED
    assert most_unpacked(10**6) == LARGEST


def test_what_is_not_compressed_is_handed_on_and_what_fails_is_told():
    assert unpack_start(TEXT, "none", 3) == (TEXT, "")
    found, reason = unpack_start(b"garbage", "zstd", 5)
    assert found == b""
    assert reason.startswith("a chunk that cannot be unpacked: ")
