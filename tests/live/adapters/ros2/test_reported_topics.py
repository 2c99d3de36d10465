import sys
from types import SimpleNamespace

import msgspec
import pytest
from rosbags.typesys import Stores, get_typestore

from roslens.live.adapters.ros2.observation import PARAMETERS_S, Observation
from roslens.live.adapters.ros2.parameters import Parameters
from roslens.live.adapters.ros2.reported_topics import DEPTH, ReportedTopics
from roslens.model.graph import Change, Endpoint, Graph, Node, Role
from roslens.model.qos import Qos as QosOf

TYPES = {
    "/parameter_events": "rcl_interfaces/msg/ParameterEvent",
    "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
    "/statistics": "statistics_msgs/msg/MetricsMessage",
}
STORE = get_typestore(Stores.ROS2_HUMBLE)


def graph(*topics, types=TYPES):
    ends = [Endpoint("/m", Role.PUBLISHER, topic, types[topic], gid="ab" * 16) for topic in topics]
    services = [
        Endpoint("/m", Role.SERVICE_SERVER, f"/m/{verb}_parameters", f"rcl_interfaces/srv/{verb.title()}Parameters")
        for verb in ("list", "get")
    ]
    return Graph("ros2", (Node("/m"),), (*ends, *services))


class Subscription:
    def __init__(self, topic):
        self.msg_type, self.topic, self.waiting, self.handle = topic, topic, [], self

    def take_message(self, kind, raw):
        if not self.waiting:
            return None
        return self.waiting.pop(0), {"publisher_gid": {"data": b"\xab" * 24}, "received_timestamp": 5_000_000_000}


@pytest.fixture
def heard(monkeypatch):
    made = ReportedTopics(
        SimpleNamespace(destroy_subscription=lambda one: closed.append(one.topic)), "vm", Parameters(Asking)
    )
    closed = made.closed = []

    def subscribe(topic, _):
        made._open[topic] = Subscription(topic)

    monkeypatch.setattr(made, "_subscribe", subscribe)
    return made


class Asking:
    def __init__(self, name):
        pass

    def step(self):
        return {"rate": "10"}

    def close(self):
        pass


def array(*statuses):
    types = STORE.types
    header = types["std_msgs/msg/Header"](types["builtin_interfaces/msg/Time"](0, 0), "")
    status = types["diagnostic_msgs/msg/DiagnosticStatus"]
    message = types["diagnostic_msgs/msg/DiagnosticArray"](header, [status(*one, "", "", []) for one in statuses])
    return bytes(STORE.serialize_cdr(message, "diagnostic_msgs/msg/DiagnosticArray"))


def test_only_topics_on_which_somebody_speaks_are_listened_to(heard):
    heard.choose(graph("/diagnostics"))
    assert set(heard._open) == {"/diagnostics"}
    heard.choose(graph("/parameter_events"))
    assert (set(heard._open), heard.closed) == ({"/parameter_events"}, ["/diagnostics"])
    heard.choose(graph("/statistics", types={"/statistics": "rosgraph_msgs/msg/Other"}))
    assert not heard._open


def test_levels_of_other_monitors_become_events(heard):
    heard.choose(graph("/diagnostics"))
    heard._open["/diagnostics"].waiting = [array((2, "motor")), array((2, "motor")), b"no array", b"nor"]
    reported = heard.take(9.0, lambda gid: "/m" if gid == "ab" * 16 else None)
    (event,) = reported.events
    assert (event.time, event.change, event.entity) == (5.0, Change.CHANGED, "node:/m")
    (failure,) = reported.failures
    assert "diagnostics of /m cannot be decoded" in failure.what


class Qos:
    RELIABLE, BEST_EFFORT = "reliable", "best effort"

    def __init__(self, depth, reliability):
        self.reliability = reliability


def test_messages_that_cannot_be_imported_are_told_once(monkeypatch):
    monkeypatch.setitem(sys.modules, "rclpy", SimpleNamespace())
    monkeypatch.setitem(sys.modules, "rclpy.qos", SimpleNamespace(QoSProfile=Qos, QoSReliabilityPolicy=Qos))
    made = ReportedTopics(SimpleNamespace(), "vm", Parameters(Asking))
    for _ in range(3):
        made.choose(graph("/statistics"))
    (failure,) = made.take(1.0, lambda gid: None).failures
    assert "/statistics cannot be read: ModuleNotFoundError" in failure.what
    assert "statistics_msgs" in failure.expected
    assert made.take(2.0, lambda gid: None).failures == []


@pytest.mark.parametrize(("offered", "asked"), [("reliable", Qos.RELIABLE), ("best_effort", Qos.BEST_EFFORT)])
def test_no_more_is_asked_for_than_is_offered(monkeypatch, offered, asked):
    opened = []
    monkeypatch.setitem(sys.modules, "rclpy", SimpleNamespace())
    monkeypatch.setitem(sys.modules, "rclpy.qos", SimpleNamespace(QoSProfile=Qos, QoSReliabilityPolicy=Qos))
    monkeypatch.setitem(sys.modules, "diagnostic_msgs", SimpleNamespace())
    monkeypatch.setitem(sys.modules, "diagnostic_msgs.msg", SimpleNamespace(DiagnosticArray="array"))
    node = SimpleNamespace(create_subscription=lambda *words, raw: opened.append((*words, raw)))
    ends = [msgspec.structs.replace(end, qos=QosOf(offered)) for end in graph("/diagnostics").endpoints]
    ReportedTopics(node, "vm", Parameters(Asking)).choose(Graph("ros2", endpoints=tuple(ends)))
    ((kind, topic, _, qos, raw),) = opened
    assert (kind, topic, qos.reliability, raw) == ("array", "/diagnostics", asked, True)


def test_a_flood_is_read_a_bounded_part_at_a_time(heard):
    heard.choose(graph("/diagnostics"))
    heard._open["/diagnostics"].waiting = [array((2, f"s{number}")) for number in range(DEPTH + 5)]
    assert len(heard.take(9.0, lambda gid: None).events) == DEPTH
    assert len(heard.take(10.0, lambda gid: None).events) == 5


def change(name, value):
    one = SimpleNamespace(name=name, value=SimpleNamespace(type=4, string_value=value))
    return SimpleNamespace(node="/m", new_parameters=[], changed_parameters=[one], deleted_parameters=[])


class Graphs:
    unsettled = False

    def update(self):
        return graph("/parameter_events")

    def sweep(self, most):
        return False

    def own(self, gid):
        return False

    def node_of(self, gid):
        return "/m"


class Counters:
    def read(self, now):
        return []

    def failures(self):
        return []

    def called(self):
        return []


def test_parameters_stand_in_the_graph_and_their_changes_are_events_without_secrets(heard):
    observation = Observation("vm", Graphs(), Counters(), None, heard)
    assert observation.changed(0.0).graph.parameters == {}
    assert observation.ask(0.0)
    assert not observation.ask(0.1)
    assert observation.changed(0.2) is None
    frame, _ = observation.period(1.0, 1.0)
    assert frame.graph.parameters == {"/m": {"rate": "10"}}
    heard._open["/parameter_events"].waiting = [change("rate", "20"), change("api_key", "hunter2")]
    frame, _ = observation.period(PARAMETERS_S, 1.0)
    assert [event.detail for event in frame.events] == ["10 is now 20", "is ***"]
    assert frame.graph is None
    frame, _ = observation.period(1.0 + PARAMETERS_S, 1.0)
    assert frame.graph.parameters == {"/m": {"rate": "20", "api_key": "***"}}
    assert "hunter2" not in repr(frame)
