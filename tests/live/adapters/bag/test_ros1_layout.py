"""The index behind a chunk, whatever the order in which a recorder writes the fields of its records."""

import struct

import pytest

from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.ros1_layout import Ros1Layout


def record(fields, content):
    header = b"".join(struct.pack("<I", len(name) + 1 + len(value)) + name + b"=" + value for name, value in fields)
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(content)) + content


def index(channel, rows, order="cno", **other):
    fields = {
        "v": (b"ver", struct.pack("<I", 1)),
        "c": (b"conn", struct.pack("<I", channel)),
        "n": (b"count", struct.pack("<I", other.get("count", len(rows)))),
        "o": (b"op", b"\x04"),
        "x": (b"extra", b"conn="),
    }
    return record([fields[name] for name in order], b"".join(struct.pack("<III", *row) for row in rows))


def read(region):
    return [(one.channel, one.times.tolist(), one.offsets.tolist()) for one in Ros1Layout().entries(region)]


FIRST, SECOND = [(7, 5, 0), (7, 9, 100)], [(4_294_967_295, 999_999_999, 4_294_967_295)]
EXPECTED = [(1, [7_000_000_005, 7_000_000_009], [0, 100]), (70_000, [4_294_967_295_999_999_999], [4_294_967_295])]


@pytest.mark.parametrize("first", ["vcno", "oncv", "xcno"])
@pytest.mark.parametrize("second", ["vcno", "oncv", "cnov", "xcno"])
def test_fields_come_in_any_order(first, second):
    assert read(index(1, FIRST, first) + index(2, [], first) + index(70_000, SECOND, second)) == EXPECTED


def test_another_record_ends_the_index():
    other = record([(b"op", b"\x05")], b"")
    assert read(index(1, FIRST) + other + index(70_000, SECOND)) == EXPECTED[:1]
    assert read(b"") == []


@pytest.mark.parametrize("order", ["vcno", "oncv"])
def test_a_record_that_lies_about_its_length_is_damaged(order):
    with pytest.raises(DamageError):
        read(index(1, FIRST, order) + index(1, FIRST, order, count=3))
    with pytest.raises(DamageError):
        read((index(1, FIRST, order) + index(1, FIRST, order))[:-1])
