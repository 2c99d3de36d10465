import itertools
import struct
import threading
import time

import pytest

from roslens.live.adapters.ros1.budget import Limits
from roslens.live.adapters.ros1.listening import Listening
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.stream import Source, Use
from roslens.live.adapters.ros1.wire.tcpros import encode_header
from roslens.model.traffic.tally import Observer

pytestmark = pytest.mark.timed

TOLD = encode_header({"callerid": "/lidar", "type": "a/Scan", "md5sum": "x", "message_definition": "Header header"})


def message(sequence, size):
    body = struct.pack("<III", sequence, 0, 0).ljust(size, b"x")
    return struct.pack("<I", len(body)) + body


@pytest.fixture
def publish(serve, script):
    """Start a node that sends these bytes to whoever connects, and keeps the line until the end."""

    def make(stream, hold=True, reported=TOLD):
        def play(line, done):
            line.recv(65536)
            line.sendall(reported + stream)
            if hold:
                done.wait()
            line.close()

        port = script(play)
        node = serve({"requestTopic": [1, "", ["TCPROS", "127.0.0.1", port]]})
        return Source(Use.TAP, "/scan", "/lidar", node.uri)

    return make


@pytest.fixture
def listen(request):
    def make(**options):
        ticks = itertools.count(1)
        listening = Listening("/me", Resolver(), lambda: next(ticks) / 1000, "vm", **options)
        request.addfinalizer(listening.close)
        return listening

    return make


def until(listening, enough, sources):
    """Take until it is enough; return all tallies and failures."""
    tallies, failures, shed, pause = [], [], 0, threading.Event()
    end = time.monotonic() + 60
    while time.monotonic() < end:
        listening.want(sources)
        taken = listening.take()
        tallies += taken.tallies
        failures += taken.failures
        shed += taken.shed
        if enough(tallies, failures, shed):
            return tallies, failures
        pause.wait(0.01)
    pytest.fail(f"not enough: {tallies} {failures}")
    return None


@pytest.mark.parametrize("size", [12, 100, 8192, 1_000_000])
def test_a_tap_counts_small_and_large_messages(publish, listen, size):
    source = publish(b"".join(message(number, size) for number in (1, 2, 5, 6)))
    tallies, failures = until(listen(), lambda found, *_: sum(t.count for t in found) >= 4, [source])
    assert not failures
    assert sum(t.count for t in tallies) == 4
    assert sum(t.bytes for t in tallies) == 4 * size
    assert sum(max(t.lost, 0) for t in tallies) == 2
    assert {(t.topic, t.publisher, t.subscriber, t.observer) for t in tallies} == {
        ("/scan", "/lidar", "", Observer.TAP)
    }


def test_what_is_no_longer_wanted_is_closed(publish, listen):
    source, listening = publish(message(1, 50)), listen()
    until(listening, lambda found, *_: sum(t.count for t in found) == 1, [source])
    listening.want([])
    listening.take()
    assert listening.take().tallies == []


def test_a_publisher_that_hangs_up_is_connected_again(publish, listen):
    source = publish(message(1, 50), hold=False)
    tallies, _ = until(listen(), lambda found, *_: sum(t.count for t in found) >= 2, [source])
    assert sum(t.bytes for t in tallies) % 50 == 0


def test_a_stream_that_is_none_is_named(publish, listen):
    _, failures = until(listen(), lambda _, failures, __: failures, [publish(b"\xff" * 16)])
    assert "expected at most" in failures[0].what
    assert failures[0].entity == "node:/lidar"


def test_a_publisher_that_refuses_is_named_once(publish, listen):
    source = publish(b"", reported=encode_header({"error": "go away"}))
    listening = listen()
    _, failures = until(listening, lambda _, failures, __: failures, [source])
    assert "go away" in failures[0].what
    listening.want([source])
    assert listening.take().failures == []


def test_a_node_that_is_gone_is_named(listen):
    source = Source(Use.TAP, "/scan", "/lidar", "http://127.0.0.1:9/")
    _, failures = until(listen(), lambda _, failures, __: failures, [source])
    assert "refuses connections" in failures[0].what


def test_a_tap_that_costs_too_much_rests_visibly_and_lets_go(publish, listen):
    source = publish(b"".join(message(number, 100) for number in range(1000)))
    listening = listen(limits=Limits(messages=10))
    tallies, failures = until(listening, lambda _, failures, shed: failures and shed, [source])
    assert "the tap rests" in failures[0].what
    assert "10 messages/s" in failures[0].what
    assert 40 < sum(t.count for t in tallies) <= 1000


def test_statistics_are_read(publish, listen):
    text = b"".join(struct.pack("<I", len(name)) + name for name in (b"/chat", b"/talker", b"/listener"))
    body = text + struct.pack("<IIIIiii12i", 1, 0, 2, 0, 50, 0, 1500, *[0] * 12)
    tap = publish(struct.pack("<I", len(body)) + body + struct.pack("<I", 5) + b"wrong")
    source = Source(Use.STATISTICS, "/statistics", "/listener", tap.uri)
    reported = []
    listening = listen(news=lambda: reported.append(len(reported)))
    tallies, failures = until(listening, lambda found, failures, _: found and failures, [source])
    assert 1 <= len(reported) <= 2  # once for each time that it was taken
    assert [(t.topic, t.subscriber, t.count, t.observer) for t in tallies] == [
        ("/chat", "/listener", 50, Observer.INSIDE)
    ]
    assert "sends no statistics" in failures[0].what
