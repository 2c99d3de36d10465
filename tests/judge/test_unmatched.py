"""Sentences about nothing."""

from __future__ import annotations

from roslens.judge.read_reference import GivenText, load_reference
from roslens.judge.unmatched import Subject, subjects_of, unmatched
from roslens.live.signals import BY_KEY
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
        "r.yaml:13: r.chain.scan.map.age is about nothing: no topic /map is there",
        "r.yaml:6: r.connection.scan.nobody.rate is about nothing: no connection /scan to /nobody is there",
        "r.yaml:11: r.field.scan.x.value is about nothing: no topic /mode is there",
        "r.yaml:9: r.node.lidar.presence is about nothing: no node /driver is there",
        "r.yaml:5: r.topic.scam.rate is about nothing: no topic /scam is there. Did you mean '/scan'?",
    ]
