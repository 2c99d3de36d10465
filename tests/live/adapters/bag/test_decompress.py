import bz2

import lz4.frame
import pytest
from backports import zstd

from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.decompress import LARGEST, decompress, unpack_start

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
