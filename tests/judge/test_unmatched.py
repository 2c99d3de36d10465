"""Constraints about nothing."""

from __future__ import annotations

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.unmatched import Subject, subjects_of, unmatched
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Process, Role

GRAPH = Graph(
    generation="ros2",
    hosts=("robot-1",),
    nodes=(Node("/lidar", "robot-1"), Node("/amcl", "robot-1")),
    processes=(Process("robot-1", 42),),
    endpoints=(
        Endpoint("/lidar", Role.PUBLISHER, "/scan", "sensor_msgs/msg/LaserScan"),
        Endpoint("/amcl", Role.SUBSCRIPTION, "/scan", "sensor_msgs/msg/LaserScan"),
        Endpoint("/amcl", Role.SERVICE_SERVER, "/set_map", "nav_msgs/srv/SetMap"),
    ),
)


def test_a_graph_is_full_of_subjects():
    assert subjects_of(GRAPH) == (
        Subject(EntityKind.CONNECTION, "/scan", "robot-1", "sensor_msgs/msg/LaserScan", "/lidar", "/amcl"),
        Subject(EntityKind.HOST, "robot-1"),
        Subject(EntityKind.NODE, "/amcl", "robot-1"),
        Subject(EntityKind.NODE, "/lidar", "robot-1"),
        Subject(EntityKind.PROCESS, "robot-1/42", "robot-1"),
        Subject(EntityKind.SERVICE, "/set_map", "robot-1", "nav_msgs/srv/SetMap"),
        Subject(EntityKind.TOPIC, "/scan", type="sensor_msgs/msg/LaserScan"),
        Subject(EntityKind.TOPIC, "/scan", type="sensor_msgs/msg/LaserScan", publisher="/lidar"),
    )


NOBODY = "connection /scan to /nobody exists. /scan is there, but to /amcl"


def test_what_matches_nothing_is_told_with_the_nearest_name():
    text = b"""\
kind: reference
name: r
constraints:
  - {topic: /scan, publisher: /lidar, rate: 1..2}
  - {topic: /scam, rate: 1..2}
  - {connection: /scan, subscriber: /nobody, rate: 1..2}
  - {node: '/**', on: robot-*, cpu: <= 5 %}
  - {node: /gone, expected: always}
  - {node: /lidar, expected: while node /driver}
fields:
  - {topic: /scan, field: x, range: 1..2, when: {topic: /mode, field: y, range: 1}}
chains:
  - {topics: [/scan, /map], age: <= 1 s}
"""
    reference = load_reference([GivenText("r.yaml", text)], BY_KEY)
    assert [str(one) for one in unmatched(reference, subjects_of(GRAPH))] == [
        "r.yaml:13: r.chain.scan.map.age matches nothing: no topic /map exists",
        f"r.yaml:6: r.connection.scan.nobody.rate matches nothing: no {NOBODY}",
        "r.yaml:11: r.field.scan.x.value matches nothing: no topic /mode exists",
        "r.yaml:9: r.node.lidar.presence matches nothing: no node /driver exists",
        "r.yaml:5: r.topic.scam.rate matches nothing: no topic /scam exists. Did you mean '/scan'?",
    ]


def reported(constraint, kinds=tuple(EntityKind), graph=GRAPH):
    text = f"kind: reference\nname: r\nconstraints:\n  - {constraint}\n"
    reference = load_reference([GivenText("r.yaml", text.encode())], BY_KEY)
    return [one.advice for one in unmatched(reference, subjects_of(graph), kinds)]


def test_patterns_get_names_too_and_types_are_told():
    assert reported("{topic: '/scann/*', rate: 1..2}") == ["Did you mean '/scan'?"]
    assert reported("{topic: '/*can', type: sensor_msgs/msg/PointCloud2, rate: 1..2}") == [
        "/scan is there, but of type sensor_msgs/msg/LaserScan"
    ]
    assert reported("{node: /lidar, on: base, cpu: <= 5 %}") == ["/lidar is there, but on robot-1"]
    assert reported("{topic: /zzz, rate: 1..2}") == [""]


def test_connections_are_where_their_publisher_is():
    graph = Graph(
        "ros2",
        (Node("/a", "one"), Node("/b", "two")),
        (Endpoint("/a", Role.PUBLISHER, "/x", "t/T"), Endpoint("/b", Role.SUBSCRIPTION, "/x", "t/T")),
    )
    assert reported("{connection: /x, on: one, rate: 1..2}", graph=graph) == []
    assert reported("{connection: /x, on: two, rate: 1..2}", graph=graph) == ["/x is there, but on one"]


def test_what_cannot_be_seen_is_not_missed():
    assert reported("{host: base, cpu: <= 5 %}", kinds=(EntityKind.TOPIC,)) == []


def test_patterns_of_field_checks_and_what_they_compare_with_are_looked_for():
    text = """kind: reference
name: r
fields:
  - {topic: "/sc*", field: range_min, change: 0..1}
  - {topic: "/wheel_*", field: ticks, change: 0..1}
  - {id: pair, topic: /scan, field: a, difference: 0..1, to: {topic: /skan, field: a}}
"""
    found = unmatched(load_reference([GivenText("r.yaml", text.encode())], BY_KEY), subjects_of(GRAPH))
    assert [str(one).partition(" exists.")[0] for one in found] == [
        "r.yaml:5: r.field.wheel_*.ticks.change matches nothing: no topic /wheel_* exists",
        "r.yaml:6: r.pair.difference matches nothing: no topic /skan",
    ]
    assert "Did you mean '/scan'?" in str(found[1])
