import struct

import pytest

from roslens.live.adapters.ros1.publishing import MonitorPublisher
from roslens.live.adapters.ros1.wire.definition import known_definitions
from roslens.live.adapters.ros1.wire.tcpros import connect
from roslens.model.acting.outgoing import VERSION, ConnectionStatistics, Outgoing, RatedSignal, RatedSignals, Status

pytestmark = pytest.mark.timed

SIGNAL = RatedSignal("topic", "/scan", "r.rate", "rate", "Hz", 1.0, 25.0, 35.0, 3, 9.0, 2, "", "5 s", "look")
FRAME = Outgoing(
    VERSION,
    5.25,
    (Status(2, "roslens: topic /scan", "rate is low", "base", (("rate", "1 Hz"),)),),
    RatedSignals("m", True, 0, 1, (SIGNAL,), (ConnectionStatistics("/scan", "/a", "/b", rate=1.0),)),
)


@pytest.fixture
def saying():
    one = MonitorPublisher("127.0.0.1", "127.0.0.1", "/roslens", diagnostics=True, rated="/rated")
    yield one
    one.close()


def heard(saying, topic):
    code, _, (protocol, host, port) = saying.answers["requestTopic"](["/me", topic, [["UDPROS"], ["TCPROS"]]])
    assert (code, protocol) == (1, "TCPROS")
    line, reported = connect(host, port, topic, "/me", 5.0)
    with line:
        line.settimeout(10)
        saying.publish(FRAME)
        size = struct.unpack("<I", line.recv(4))[0]
        body = b""
        while len(body) < size:
            body += line.recv(size - len(body))
    return reported, body


def test_diagnostics(saying):
    reported, body = heard(saying, "/diagnostics")
    assert (reported.type, reported.stamped) == ("diagnostic_msgs/DiagnosticArray", True)
    assert struct.unpack_from("<III", body) == (1, 5, 250_000_000)
    assert b"\x14\x00\x00\x00roslens: topic /scan" in body


def test_rated_signals(saying):
    reported, body = heard(saying, "/rated")
    assert (reported.type, reported.md5) == (
        "roslens_msgs/RatedSignals",
        known_definitions().md5("roslens_msgs/RatedSignals"),
    )
    assert struct.pack("<ddd", 1.0, 25.0, 35.0) in body


def test_what_it_publishes_is_told_to_who_asks(saying):
    ask = saying.answers
    assert ask["getPublications"](["/me"])[2] == [
        ["/diagnostics", "diagnostic_msgs/DiagnosticArray"], ["/rated", "roslens_msgs/RatedSignals"],
    ]  # fmt: skip
    assert ask["requestTopic"](["/me", "/other", [["TCPROS"]]])[0] == -1
    assert ask["requestTopic"](["/me", "/rated", [["UDPROS", 1]]])[0] == 0
    assert ask["requestTopic"](["/me"])[0] == -1


def test_only_what_was_asked_for():
    one = MonitorPublisher("127.0.0.1", "127.0.0.1", "/roslens", diagnostics=False, rated="/rated")
    one.publish(FRAME)
    one.close()
    assert one.publications == (("/rated", "roslens_msgs/RatedSignals"),)
