import struct

import numpy as np
import pytest

from roslens.live.adapters.bag.block import NO_STAMP
from roslens.live.adapters.bag.channel import Channel
from roslens.live.adapters.bag.stamp import begins_with_header, stamps_of

IDL = """// generated
module pkg { module msg {
  @verbatim (language="comment", text="struct Thing { int32 x; }")
  struct Thing {
    /* first */
    @verbatim (language="comment", text="the (header)")
    std_msgs::msg::Header header;
    int32 x;
  };
  struct Other { int32 x; };
}; };
"""


@pytest.mark.parametrize(
    ("language", "definition", "kind", "expected"),
    [
        ("msg", "# comment\n\nuint8 A=1\nstring<=5 B = x\nstd_msgs/Header header  # why\nint32 x", "p/T", True),
        ("msg", "Header header", "p/T", True),
        ("msg", "std_msgs/msg/Header header", "p/T", True),
        ("msg", "Header[] headers", "p/T", False),
        ("msg", "int32 x\nHeader header", "p/T", False),
        ("msg", "MyHeader header", "p/T", False),
        ("msg", "\n====\nHeader header", "p/T", False),
        ("msg", "", "p/T", False),
        ("idl", IDL, "pkg/msg/Thing", True),
        ("idl", IDL, "pkg/msg/Other", False),
        ("", "", "sensor_msgs/msg/Imu", True),
        ("", "", "std_msgs/msg/String", False),
        ("", "", "unknown/msg/Type", False),
    ],
)
def test_which_messages_begin_with_a_header(language, definition, kind, expected):
    channel = Channel("/a", kind, definition=definition, language=language, encoding="cdr")
    assert begins_with_header(channel) is expected


def test_stamps_of_either_byte_order_unset_ones_and_short_messages():
    contents = [
        b"\x00\x01\x00\x00" + struct.pack("<iI", -3, 7),
        b"\x00\x00\x00\x00" + struct.pack(">iI", 5, 9),
        b"\x00\x01\x00\x00" + bytes(8),
        b"\x00\x01\x00\x00\x01",
    ]
    sizes = np.array([len(content) for content in contents], np.int64)
    starts = np.cumsum(sizes) - sizes
    joined = np.frombuffer(b"".join(contents), np.uint8)
    found = stamps_of(joined, starts, sizes, Channel("/a", encoding="cdr"))
    assert found.tolist() == [-3 * 10**9 + 7, 5 * 10**9 + 9, NO_STAMP, NO_STAMP]
