"""A graph as a message: fields and numbers as rosgraph_msgs has them, and back."""

from __future__ import annotations

import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.live.observe.read_rosgraph import read_rosgraph
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.qos import Qos
from roslens.report.graph.to_rosgraph import to_rosgraph

HASH = "RIHS01_" + "0a" * 32
QOS = Qos("reliable", "transient_local", "keep_last", 5, 0.25, 0.0, "automatic", 1.5)
GRAPH = Graph(
    "ros2",
    (Node("/lidar", "one", 7), Node("/slam")),
    (
        Endpoint("/lidar", Role.PUBLISHER, "/scan", "sensor_msgs/msg/LaserScan", HASH, QOS, "ab"),
        Endpoint("/slam", Role.SUBSCRIPTION, "/scan", "sensor_msgs/msg/LaserScan"),
        Endpoint("/slam", Role.SERVICE_SERVER, "/reset", "std_srvs/srv/Empty"),
        Endpoint("/slam", Role.ACTION_CLIENT, "/go", "nav2_msgs/action/Go"),
    ),
    ("one",),
    parameters={"/slam": {"rate": "10", "gain": "0.5", "on": "true", "frame": "map", "ids": "[1, 2]"}},
)
UNKNOWN = {"version": 0, "value": [0] * 32}


def test_fields_and_numbers_are_those_of_the_message():
    lidar, slam = yaml.safe_load(to_rosgraph(GRAPH))["nodes"]
    assert list(lidar) == [
        "parameters",
        "publishers",
        "subscriptions",
        "service_clients",
        "service_servers",
        "action_clients",
        "action_servers",
        "name",
        "parameter_values",
    ]
    assert lidar["name"] == "/lidar"
    assert lidar["publishers"] == [
        {
            "name": "/scan",
            "type": {"name": "sensor_msgs/msg/LaserScan", "hash": {"version": 1, "value": [10] * 32}},
            "qos": {
                "depth": 5,
                "deadline": {"sec": 0, "nanosec": 250_000_000},
                "lifespan": {"sec": 0, "nanosec": 0},
                "history": 1,
                "reliability": 1,
                "durability": 1,
                "liveliness": 1,
                "liveliness_lease_duration": {"sec": 1, "nanosec": 500_000_000},
            },
        }
    ]
    unknown = slam["subscriptions"][0]["qos"]
    assert [unknown[key] for key in ("history", "reliability", "durability", "liveliness")] == [3, 3, 3, 4]
    assert slam["subscriptions"][0]["type"]["hash"] == UNKNOWN
    assert slam["service_servers"] == [
        {
            "name": "/reset",
            "request_type": {"name": "std_srvs/srv/Empty_Request", "hash": UNKNOWN},
            "response_type": {"name": "std_srvs/srv/Empty_Response", "hash": UNKNOWN},
        }
    ]
    assert [slam["action_clients"][0][f"{part}_type"]["name"].rpartition("_")[2] for part in PARTS] == [
        "Goal",
        "Result",
        "Feedback",
    ]


PARTS = ("request", "response", "feedback")


def test_values_match_their_parameters_one_to_one():
    slam = yaml.safe_load(to_rosgraph(GRAPH))["nodes"][1]
    names = [one["name"] for one in slam["parameters"]]
    assert dict(zip(names, slam["parameter_values"], strict=True)) == {
        "frame": {"type": 4, "string_value": "map"},
        "gain": {"type": 3, "double_value": 0.5},
        "ids": {"type": 7, "integer_array_value": [1, 2]},
        "on": {"type": 1, "bool_value": True},
        "rate": {"type": 2, "integer_value": 10},
    }


def test_an_empty_graph_is_one_too():
    assert to_rosgraph(Graph("")) == "nodes: []\n"


NAMES = st.text(st.sampled_from("ab/ é\"'#:-{}[],&*!|>%@\\\u2028🤖"), max_size=8).map(lambda text: f"/{text}/x")
ENDS = st.builds(Endpoint, NAMES, st.sampled_from(Role), NAMES, st.just("a/b/C"))


@settings(max_examples=50, deadline=None)
@given(st.lists(ENDS, max_size=6, unique=True), st.lists(NAMES, max_size=3, unique=True))
def test_it_is_read_back(tmp_path_factory, ends, names):
    everybody = sorted({*names, *(end.node for end in ends)})
    graph = Graph("ros2", tuple(map(Node, names)), tuple(ends))
    text = to_rosgraph(graph)
    path = tmp_path_factory.mktemp("graph") / "graph.yaml"
    path.write_text(text, "utf-8")
    back = read_rosgraph(path)
    assert [node.name for node in back.nodes] == everybody
    assert sorted(map(key, back.endpoints)) == sorted(map(key, ends))


def key(end: Endpoint) -> tuple[str, ...]:
    return end.node, end.role.value, end.name, end.type


def test_lists_are_arrays_as_far_as_their_items_say():
    texts = {"a": "[]", "b": "[front, 'left']", "c": "[1, 2.5]", "d": "[true]", "e": "[1, a]", "f": "1e3", "g": "1e999"}
    graph = Graph("ros2", (Node("/n"),), parameters={"/n": texts})
    (node,) = yaml.safe_load(to_rosgraph(graph))["nodes"]
    assert node["parameter_values"] == [
        {"type": 9, "string_array_value": []},
        {"type": 9, "string_array_value": ["front", "left"]},
        {"type": 8, "double_array_value": [1.0, 2.5]},
        {"type": 6, "bool_array_value": [True]},
        {"type": 9, "string_array_value": ["1", "a"]},
        {"type": 3, "double_value": 1000.0},
        {"type": 4, "string_value": "1e999"},
    ]
