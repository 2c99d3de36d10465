import sys
import types

import pytest

from roslens.live.adapters.ros2.publishing import MonitorPublisher
from roslens.model.acting.outgoing import VERSION, ConnectionStatistics, Outgoing, RatedSignal, RatedSignals, Status

SIGNAL = RatedSignal("topic", "/scan", "r.rate", "rate", "Hz", 1.0, 25.0, 35.0, 3, 9.0, 2, "", "5 s", "look")
FRAME = Outgoing(
    VERSION,
    5.25,
    (Status(2, "roslens: topic /sc\0an\udc80", "rate is low", "base", (("rate", "1 Hz"),)),),
    RatedSignals("m", True, 0, 1, (SIGNAL,), (ConnectionStatistics("/scan", "/a", "/b", rate=1.0),)),
)


class Message:
    def __init__(self, **fields):
        self.header = types.SimpleNamespace(stamp=types.SimpleNamespace())
        vars(self).update(fields)


class Node:
    """Keeps what is published, by topic."""

    def __init__(self, refused=""):
        self.said = {}
        self.refused = refused

    def create_publisher(self, kind, topic, depth):
        if topic == self.refused:
            raise RuntimeError("another type is there")
        self.said[topic] = []
        return types.SimpleNamespace(publish=self.said[topic].append)


@pytest.fixture
def packages(monkeypatch):
    """Packages of messages that are there."""

    def make(package, *names):
        module = types.ModuleType(f"{package}.msg")
        for name in names:
            setattr(module, name, type(name, (Message,), {}))
        monkeypatch.setitem(sys.modules, package, types.ModuleType(package))
        monkeypatch.setitem(sys.modules, f"{package}.msg", module)

    make("diagnostic_msgs", "DiagnosticArray", "DiagnosticStatus", "KeyValue")
    return make


def test_diagnostics_are_filled_and_texts_are_such_as_ros_takes(packages):
    node = Node()
    saying = MonitorPublisher(node, diagnostics=True, rated="")
    saying.publish(FRAME)
    (array,) = node.said["/diagnostics"]
    assert (array.header.stamp.sec, array.header.stamp.nanosec) == (5, 250_000_000)
    (status,) = array.status
    assert (status.level, status.message, status.hardware_id) == (b"\x02", "rate is low", "base")
    assert status.name == "roslens: topic /sc\N{REPLACEMENT CHARACTER}an?"
    assert [(one.key, one.value) for one in status.values] == [("rate", "1 Hz")]
    assert list(node.said) == ["/diagnostics"]


def test_rated_signals_are_filled(packages):
    packages("roslens_msgs", "RatedSignals", "RatedSignal", "ConnectionStatistics")
    node = Node()
    saying = MonitorPublisher(node, diagnostics=False, rated="/rated")
    saying.publish(FRAME)
    (rated,) = node.said["/rated"]
    assert (rated.monitor, rated.complete, rated.part, rated.parts, rated.header.stamp.sec) == ("m", True, 0, 1, 5)
    assert (rated.signals[0].name, rated.signals[0].high, rated.signals[0].state) == ("/scan", 35.0, 3)
    assert rated.connections[0].rate == 1.0
    assert not saying.failures


def test_a_package_that_is_not_there_is_told_and_the_rest_is_published(packages):
    node = Node()
    saying = MonitorPublisher(node, diagnostics=True, rated="/rated")
    (failure,) = saying.failures
    assert "nothing is published on /rated: ModuleNotFoundError: No module named 'roslens_msgs'" in failure.what
    assert "Build roslens_msgs" in failure.advice
    saying.publish(FRAME)
    assert len(node.said["/diagnostics"]) == 1


def test_a_topic_that_is_refused_is_told(packages):
    saying = MonitorPublisher(Node(refused="/diagnostics"), diagnostics=True, rated="")
    assert "RuntimeError: another type is there" in saying.failures[0].what
    saying.publish(FRAME)


def test_after_the_end_nothing_is_published(packages):
    node = Node()
    saying = MonitorPublisher(node, diagnostics=True, rated="")
    saying.close()
    saying.publish(FRAME)
    assert node.said["/diagnostics"] == []
