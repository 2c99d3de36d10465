import contextlib
import socket
import struct
import time

import pytest

from roslens.live.adapters.ros1.wire.tcpros import TcprosError, connect, decode_header, encode_header
from roslens.live.adapters.ros1.wire.topic_server import MOST_WAITING, Published, TopicServer

pytestmark = pytest.mark.timed

TOPIC = "/diagnostics"
KNOWN = Published("p/M", "a" * 32, "uint8 x")


@pytest.fixture
def server():
    one = TopicServer("127.0.0.1", "/roslens", {TOPIC: KNOWN})
    yield one
    one.close()


def exactly(line, size):
    found = b""
    while len(found) < size:
        piece = line.recv(size - len(found))
        assert piece, found
        found += piece
    return found


def block(line):
    return exactly(line, struct.unpack("<I", exactly(line, 4))[0])


def subscribe(server, **changed):
    line = socket.create_connection(("127.0.0.1", server.port), timeout=10)
    fields = {"callerid": "/me", "topic": TOPIC, "type": "p/M", "md5sum": "a" * 32, "tcp_nodelay": "1", **changed}
    line.sendall(encode_header(fields))
    return line, decode_header(block(line))


def test_a_subscriber_is_met_and_told_everything_that_follows(server):
    line, reported = subscribe(server)
    with line:
        assert reported == {
            "callerid": "/roslens", "latching": "1", "md5sum": KNOWN.md5, "message_definition": KNOWN.definition,
            "topic": TOPIC, "type": KNOWN.type,
        }  # fmt: skip
        for text in (b"one", b"", b"three"):
            server.publish(TOPIC, text)
        assert [block(line), block(line), block(line)] == [b"one", b"", b"three"]


def test_who_comes_late_gets_the_last_message(server):
    server.publish(TOPIC, b"old")
    server.publish(TOPIC, b"new")
    with subscribe(server)[0] as first:
        assert block(first) == b"new"
        with subscribe(server, type="*", md5sum="*")[0] as second:
            assert block(second) == b"new"
            server.publish(TOPIC, b"newer")
            assert (block(first), block(second)) == (b"newer", b"newer")


def test_our_own_reader_understands_it(server):
    line, reported = connect("127.0.0.1", server.port, TOPIC, "/tap", 5.0)
    line.close()
    assert (reported.caller, reported.type, reported.md5) == ("/roslens", "p/M", KNOWN.md5)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"topic": "/other"}, "'/other' is not published here"),
        ({"type": "p/N"}, "type is 'p/N', expected 'p/M'"),
        ({"md5sum": "b"}, f"md5sum is 'b', expected '{'a' * 32}'"),
    ],
)
def test_what_does_not_fit_is_refused_with_a_reason(server, changed, said):
    line, reported = subscribe(server, **changed)
    with line:
        assert reported == {"error": said}
        assert line.recv(1) == b""
    with pytest.raises(TcprosError, match="is not published here"):
        connect("127.0.0.1", server.port, "/other", "/tap", 5.0)


@pytest.mark.parametrize("garbage", [b"GET / HTTP/1.1\r\n\r\n", b"\x05\x00\x00\x00hello", b"\xff\xff\xff\xff"])
def test_garbage_is_hung_up_on(server, garbage):
    with socket.create_connection(("127.0.0.1", server.port), timeout=10) as line:
        line.sendall(garbage)
        with contextlib.suppress(ConnectionResetError):  # bytes were left unread there
            assert line.recv(1) == b""
    with subscribe(server)[0] as other:
        server.publish(TOPIC, b"still here")
        assert block(other) == b"still here"


def test_who_does_not_read_loses_messages_and_others_do_not(server):
    with subscribe(server)[0] as slow, subscribe(server)[0] as quick:
        body, count = b"x" * 500_000, 0
        end = time.monotonic() + 30
        while not server.lost:
            assert time.monotonic() < end
            server.publish(TOPIC, body)
            assert block(quick) == body
            count += 1
        assert count > MOST_WAITING / len(body)
        slow.shutdown(socket.SHUT_RDWR)
        server.publish(TOPIC, b"on")
        assert block(quick) == b"on"
