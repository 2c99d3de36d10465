import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.monitor import Monitor
from roslens.live.system.connection import Connection
from roslens.live.system.topic import ENDS
from roslens.live.window.signals import BY_KEY
from roslens.live.window.traffic import MEASURES
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Process, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Tally
from roslens.model.verdict import State

REFERENCE = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {service: /add, response_time_max: "<= 100 ms"}
"""
ADD = EntityId(EntityKind.SERVICE, "/add")
SEVEN = EntityId(EntityKind.PROCESS, "base/7")
GRAPH = Graph(
    "ros2",
    (Node("/adder", "base", 7),),
    (Endpoint("/adder", Role.SERVICE_SERVER, "/add", "demo/srv/Add"), Endpoint("/user", Role.SERVICE_CLIENT, "/add")),
    processes=(Process("base", 7, "/usr/bin/python3 /home/robot/adder.py --fast"),),
)


def monitor_of():
    return Monitor(load_reference([GivenText("rover.yaml", REFERENCE.encode())], BY_KEY), start=0.0)


@pytest.fixture
def monitor():
    return monitor_of()


def watched(monitor, slowest):
    monitor.add_graph(GRAPH, 0.5)
    for time in (1.0, 2.0, 3.0):
        monitor.add_sample(Sample(ADD, time, {"calls": 2.0, "response_time": 0.01, "response_time_max": slowest}))
        monitor.add_sample(Sample(SEVEN, time, {"cpu": 1.0}))
        monitor.tick(time)
    (host,) = monitor.tree(3.0).children
    return {part.id: part for part in host.children}


def test_a_service_is_below_the_node_that_serves_it(monitor):
    (service,) = watched(monitor, 0.02)["node:/adder"].children
    assert (service.kind, service.name, service.state) == ("service", "/add", State.OK)
    assert service.values == {"calls": 2.0, "response_time": 0.01, "response_time_max": 0.02}


def test_a_slow_service_is_told_of_the_node_and_the_host_too(monitor):
    parts = watched(monitor, 0.2)
    assert (parts["node:/adder"].state, parts["node:/adder"].worst) == (None, State.HIGH)
    assert parts["node:/adder"].children[0].counts == {"high": 1}
    assert "process:base/7" in parts


def test_a_process_is_shown_with_the_name_of_its_program(monitor):
    assert watched(monitor, 0.02)["process:base/7"].name == "base/7 adder.py"


def test_a_service_without_a_server_is_below_nobody(monitor):
    monitor.add_sample(Sample(ADD, 1.0, {"client_calls": 2.0}))
    monitor.tick(1.0)
    (nobody,) = monitor.tree(1.0).children
    assert [part.id for node in nobody.children for part in node.children] == ["service:/add"]


def asked(monkeypatch, monitor, publishers):
    """How many connections are asked for a value by a tree of so many nodes that publish one topic."""
    ends = [
        Endpoint(f"/n{number}", Role.PUBLISHER, "/rosout", "rcl_interfaces/msg/Log") for number in range(publishers)
    ]
    monitor.add_graph(Graph("ros2", tuple(Node(end.node, "base", 7) for end in ends), tuple(ends)), 0.5)
    monitor.add_tallies([Tally("/rosout", end.node, "", 0.0, 1.0, 3, first=0.1, last=0.9) for end in ends])
    monitor.tick(1.0)
    count = 0
    value = Connection.value

    def counted(*given, **named):
        nonlocal count
        count += 1
        return value(*given, **named)

    monkeypatch.setattr(Connection, "value", counted)
    host = next(part for part in monitor.tree(1.0).children if part.name == "base")
    monkeypatch.undo()
    rates = {part.children[0].values["rate"] for part in host.children}
    assert len(rates) == 1
    assert rates.pop() > publishers
    return count


def test_a_topic_of_many_publishers_is_folded_once(monkeypatch):
    few, many = (asked(monkeypatch, monitor_of(), publishers) for publishers in (100, 200))
    assert many <= 2.1 * few


def test_the_values_of_a_topic_are_those_it_tells_one_by_one(monitor):
    monitor.add_graph(GRAPH, 0.5)
    pair = [
        Tally("/scan", f"/n{number}", "/map", 0.0, 1.0, 3 + number, bytes=30, first=0.1, last=0.9) for number in (0, 1)
    ]
    monitor.add_tallies(pair)
    monitor.tick(1.0)
    topic = monitor.world.topics["/scan"]
    keys = (*MEASURES, *ENDS)
    assert dict(topic.values(keys, 0)) == {key: topic.value(key, 0) for key in keys}
    assert topic.value("rate", 0)[0] == pytest.approx(6.25)
