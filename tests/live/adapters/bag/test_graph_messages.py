"""Graphs that were recorded: who publishes, takes and serves what, in the messages of both packages that have one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from roslens.live.adapters.bag.open_bag import open_bag
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.qos import Qos

SECOND = 10**9
QOS = """uint32 depth
builtin_interfaces/Duration deadline
builtin_interfaces/Duration lifespan
uint8 history
uint8 reliability
uint8 durability
uint8 liveliness
builtin_interfaces/Duration liveliness_lease_duration"""
OF_ROS = {
    "Graph": "Node[] nodes",
    "Node": "rcl_interfaces/ParameterDescriptor[] parameters\nTopic[] publishers\nTopic[] subscriptions\n"
    "Service[] service_servers\nstring name\nrcl_interfaces/ParameterValue[] parameter_values",
    "Topic": "string name\nInterfaceType type\nQoSProfile qos",
    "Service": "string name\nInterfaceType request_type",
    "InterfaceType": "string name\nTypeHash hash",
    "TypeHash": "uint8 version\nuint8[32] value",
    "QoSProfile": QOS,
}
OF_MONITOR = {
    "Graph": "NodeInfo[] nodes",
    "NodeInfo": "string name\nTopic[] publishers\nTopic[] subscriptions",
    "Topic": "string name\nstring type\nQosProfile qos",
    "QosProfile": QOS,
}
STRING = "std_msgs/msg/String"


class Messages:
    """The messages of a package, made by name."""

    def __init__(self, package: str, definitions: dict[str, str]) -> None:
        self.store: Typestore = get_typestore(Stores.ROS2_JAZZY)
        types = {}
        for name, text in definitions.items():
            types.update(get_types_from_msg(text, f"{package}/msg/{name}"))
        self.store.register(types)
        self.package = package

    def __call__(self, name: str, *values: Any) -> Any:
        return self.store.types[name if "/" in name else f"{self.package}/msg/{name}"](*values)

    def duration(self, seconds: int) -> Any:
        return self("builtin_interfaces/msg/Duration", seconds, 0)


def of_ros(*publishers: str, deadline_s: int = 0, limit: float = 0.5) -> tuple[Messages, Any]:
    """Return a graph in which these publish /chat, and a listener serves and has parameters."""
    new = Messages("rosgraph_msgs", OF_ROS)
    never, digest = new.duration(0), np.arange(32, dtype=np.uint8)
    type_ = new("InterfaceType", STRING, new("TypeHash", 1, digest))
    qos = new("QoSProfile", 7, new.duration(deadline_s), new.duration(2**31 - 1), 1, 2, 1, 1, never)
    chat = new("Topic", "/chat", type_, qos)
    request = new("InterfaceType", "std_srvs/srv/Empty_Request", new("TypeHash", 0, np.zeros(32, np.uint8)))
    nodes = [new("Node", [], [chat], [], [], name, []) for name in publishers]
    described = [
        new("rcl_interfaces/msg/ParameterDescriptor", name, 3, "", "", False, False, [], [])
        for name in ("limit", "token")
    ]
    empty = {kind: np.zeros(0, kind) for kind in ("uint8", "bool", "int64", "float64")}
    values = [
        new("rcl_interfaces/msg/ParameterValue", kind, False, 0, limit, "secret", *empty.values(), [])
        for kind in (3, 4)
    ]
    nodes.append(new("Node", described, [], [chat], [new("Service", "/reset", request)], "/listener", values))
    return new, new("Graph", nodes)


def of_monitor() -> tuple[Messages, Any]:
    """Return the same with the message of graph-monitor, which numbers reliability the other way round."""
    new = Messages("rosgraph_monitor_msgs", OF_MONITOR)
    never = new.duration(0)
    chat = new("Topic", "/chat", STRING, new("QosProfile", 7, never, never, 1, 1, 1, 1, never))
    return new, new("Graph", [new("NodeInfo", "/talker", [chat], [])])


def recorded(folder: Path, new: Messages, *graphs: Any, damaged: bool = False) -> Path:
    """Write a recording with a message on /chat and /other each second, and these graphs at 1 s, 2 s and so on."""
    kind = f"{new.package}/msg/Graph"
    with Writer(folder / "drive", version=9, storage_plugin=StoragePlugin.MCAP) as bag:
        lines = {name: bag.add_connection(name, STRING, typestore=new.store) for name in ("/chat", "/other")}
        reported = bag.add_connection("/rosgraph", kind, typestore=new.store)
        text = bytes(new.store.serialize_cdr(new("std_msgs/msg/String", "x"), STRING))
        for second in range(1, 5):
            for line in lines.values():
                bag.write(line, second * SECOND, text)
            if second <= len(graphs):
                content = bytes(new.store.serialize_cdr(graphs[second - 1], kind))
                bag.write(reported, second * SECOND, content[: len(content) // 2] if damaged else content)
    return folder / "drive"


def test_a_recorded_graph_says_who_publishes_takes_and_serves(tmp_path: Path) -> None:
    bag = open_bag(recorded(tmp_path, *of_ros("/talker", deadline_s=2)))
    qos = Qos("best_effort", "transient_local", "keep_last", 7, 2.0, 0.0, "automatic", 0.0)
    digest = "RIHS01_" + bytes(range(32)).hex()
    assert bag.graph() == Graph(
        "ros2",
        (Node("/listener"), Node("/talker")),
        (
            Endpoint("/listener", Role.SERVICE_SERVER, "/reset", "std_srvs/srv/Empty"),
            Endpoint("/listener", Role.SUBSCRIPTION, "/chat", STRING, digest, qos),
            Endpoint("/talker", Role.PUBLISHER, "/chat", STRING, digest, qos),
            # What nobody publishes by the graph was recorded all the same; the topic of the graph is no part of it.
            *(end for end in bag.graph().endpoints if end.name == "/other"),
        ),
        parameters={"/listener": {"limit": "0.5", "token": "***"}},
    )
    assert [end.node for end in bag.graph().endpoints if end.name == "/other"] == [""]
    assert not bag.failures


def test_traffic_of_the_only_publisher_is_its(tmp_path: Path) -> None:
    bag = open_bag(recorded(tmp_path, *of_ros("/talker")))
    assert {lane.publisher for _, lanes in bag.tallies() for lane in lanes if lane.topic == "/chat"} == {"/talker"}
    assert {lane.publisher for _, lanes in bag.tallies() for lane in lanes if lane.topic == "/other"} == {""}


def test_of_two_publishers_nobody_can_tell_whose_it_was(tmp_path: Path) -> None:
    new, one = of_ros("/talker")
    bag = open_bag(recorded(tmp_path, new, one, of_ros("/second")[1]))
    assert {lane.publisher for _, lanes in bag.tallies() for lane in lanes if lane.topic == "/chat"} == {""}
    assert [time for time, _ in bag.graphs] == [1.0, 2.0]
    assert {node.name for node in bag.graph().nodes} == {"/second", "/listener"}


def test_graphs_that_are_the_same_count_once(tmp_path: Path) -> None:
    new, one = of_ros("/talker")
    bag = open_bag(recorded(tmp_path, new, one, one, of_ros("/talker", limit=0.25)[1]))
    assert [time for time, _ in bag.graphs] == [1.0, 3.0]


def test_the_message_of_graph_monitor_is_read_by_its_own_numbers(tmp_path: Path) -> None:
    (end,) = (one for one in open_bag(recorded(tmp_path, *of_monitor())).graph().endpoints if one.name == "/chat")
    assert (end.node, end.type, end.hash) == ("/talker", STRING, "")
    assert end.qos == Qos("best_effort", "transient_local", "keep_last", 7, 0.0, 0.0, "automatic", 0.0)


@pytest.mark.parametrize("cut", [False, True])
def test_a_graph_that_cannot_be_read_is_told_and_the_rest_is_there(tmp_path: Path, cut: bool) -> None:
    bag = open_bag(recorded(tmp_path, *of_ros("/talker"), damaged=cut))
    assert bool(bag.graphs) is not cut
    assert [failure.what for failure in bag.failures if '"/rosgraph" has a graph' in failure.what] == [
        failure.what for failure in bag.failures
    ]
    assert bool(bag.failures) is cut
    assert sum(tally.count for _, tallies in bag.tallies() for tally in tallies if tally.topic == "/chat") == 4
