import contextlib
import socket
import struct
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros1.wire.tcpros import (
    HeadReader,
    TcprosError,
    connect,
    decode_header,
    encode_header,
    is_stamped,
)

pytestmark = pytest.mark.timed

FIELDS = st.dictionaries(st.text(st.characters(codec="utf-8", exclude_characters="="), max_size=9), st.text(max_size=9))


def message(body):
    return struct.pack("<I", len(body)) + body


@given(FIELDS)
def test_fields_survive(fields):
    packed = encode_header(fields)
    assert int.from_bytes(packed[:4], "little") == len(packed) - 4
    assert decode_header(packed[4:]) == fields


@given(st.binary(max_size=100))
def test_no_header_makes_it_fall_over(body):
    with contextlib.suppress(TcprosError):
        decode_header(body)


def test_too_many_fields_are_refused():
    with pytest.raises(TcprosError, match="expected fields"):
        decode_header(encode_header({str(number): "" for number in range(101)})[4:])


@pytest.mark.parametrize(
    ("type_", "definition", "stamped"),
    [
        ("std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id", True),
        ("a/B", "# a comment\n\nHeader header # when\nint32 x\n=====\nMSG: std_msgs/Header\n", True),
        ("a/B", "int32 KIND=1\nstd_msgs/Header header\n", True),
        ("a/B", "int32 x\nHeader header\n", False),
        ("a/B", "Headers many\n", False),
        ("a/B", "Header[] many\n", False),
        ("a/B", "C c\n=====\nMSG: a/C\nHeader header\n", False),
        ("a/B", "", False),
    ],
)
def test_what_begins_with_a_header(type_, definition, stamped):
    assert is_stamped(type_, definition) is stamped


@given(st.lists(st.binary(max_size=60), max_size=8), st.lists(st.integers(1, 70), min_size=1, max_size=20))
def test_messages_in_any_pieces(bodies, cuts):
    stream, reader, found = b"".join(map(message, bodies)), HeadReader(), []
    while stream:
        for cut in cuts:
            found += reader.feed(stream[:cut])
            stream = stream[cut:]
    assert found == [(len(body), body[:12]) for body in bodies]
    assert reader.left == 0


@given(st.binary(max_size=200))
def test_no_stream_makes_it_fall_over(stream):
    reader = HeadReader()
    with contextlib.suppress(TcprosError):
        reader.feed(stream)
    assert reader.left >= 0


def test_a_message_longer_than_any_is_refused():
    with pytest.raises(TcprosError, match="4,294,967,295 bytes"):
        HeadReader().feed(b"\xff" * 8)


def shake(script, answer, wait_s=2.0):
    heard = []

    def play(line, done):
        size = int.from_bytes(line.recv(4), "little")
        heard.append(decode_header(line.recv(size)))
        line.sendall(answer)
        if not answer:
            done.wait()
        line.close()

    line, reported = connect("127.0.0.1", script(play), "/chat", "/me", wait_s)
    line.close()
    return heard[0], reported


def test_the_handshake_takes_any_type(script):
    reported = {"callerid": "/talker", "type": "a/B", "md5sum": "abc", "message_definition": "Header header"}
    asked, found = shake(script, encode_header(reported))
    assert (asked["callerid"], asked["topic"], asked["type"], asked["md5sum"]) == ("/me", "/chat", "*", "*")
    assert (found.caller, found.type, found.md5, found.stamped) == ("/talker", "a/B", "abc", True)


@pytest.mark.parametrize(
    ("answer", "found"),
    [
        (encode_header({"error": "topic [/chat] is not published here"}), "refuses: topic"),
        (b"HTTP/1.1 400 Bad Request\r\n\r\n", "bytes, expected at most"),
        (b"\x10\0\0\0abc", "hung up"),
        (b"\x08\0\0\0\x04\0\0\0abcd", "expected fields"),
    ],
)
def test_a_handshake_that_is_none(script, answer, found):
    with pytest.raises(TcprosError, match=found):
        shake(script, answer)


def test_a_handshake_that_never_comes_ends_in_time(script):
    begun = time.monotonic()
    with pytest.raises(TimeoutError):
        shake(script, b"", wait_s=0.1)
    assert time.monotonic() - begun < 30, "the other side stays silent for ever"


def test_nobody_there():
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    with pytest.raises(ConnectionRefusedError):
        connect("127.0.0.1", port, "/chat", "/me", 1.0)
