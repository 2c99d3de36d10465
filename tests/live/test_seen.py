"""What was there at any time of a watch."""

from __future__ import annotations

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.unmatched import Subject, unmatched
from roslens.live.join import seen
from roslens.live.join.seen import Seen
from roslens.live.system.world import World
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Process, Role
from roslens.model.traffic.tally import Tally

BEFORE = Graph("ros2", (Node("/a", "one"),), (Endpoint("/a", Role.PUBLISHER, "/x", "t/T"),), ("one",))
AFTER = Graph("ros2", (Node("/b", "two"),), (), ("two",), (Process("two", 7),))


def test_what_is_gone_is_remembered():
    found = Seen()
    found.add_graph(BEFORE)
    found.add_graph(AFTER)
    assert found.subjects(World()) == (
        Subject(EntityKind.HOST, "one"),
        Subject(EntityKind.HOST, "two"),
        Subject(EntityKind.NODE, "/a", "one"),
        Subject(EntityKind.NODE, "/b", "two"),
        Subject(EntityKind.PROCESS, "two/7", "two"),
        Subject(EntityKind.TOPIC, "/x", type="t/T", publisher="/a"),
    )


def test_what_is_known_by_traffic_alone_counts_and_what_is_only_expected_does_not():
    world = World()
    tally = Tally("/x", "/a", "/b", 0.0, 1.0, 5)
    connection = world.connection(tally, 0.0)
    world.topic("/x", 0.0).add(connection)
    world.topic("/expected", 0.0)
    world.entity(EntityId(EntityKind.NODE, "/expected"), 0.0)
    assert Seen().subjects(world) == (
        Subject(EntityKind.CONNECTION, "/x", publisher="/a", subscriber="/b"),
        Subject(EntityKind.TOPIC, "/x", publisher="/a"),
    )


def test_names_without_end_are_not_remembered_without_end(monkeypatch):
    monkeypatch.setattr(seen, "MOST", 10)
    found = Seen()
    for number in range(100):
        found.add_graph(Graph("ros2", (Node(f"/anonymous_{number}"),)))
    assert len(found.subjects(World())) == 10


def test_of_names_that_differ_in_numbers_alone_the_first_hundred_are_remembered():
    found = Seen()
    for number in range(1000):
        found.add_graph(Graph("ros2", (Node(f"/_ros2cli_{number}"), Node("/stays"))))
    named = [one.name for one in found.subjects(World()) if one.kind is EntityKind.NODE]
    assert len(named) == seen.MOST_ALIKE + 1
    assert {"/_ros2cli_0", "/_ros2cli_99", "/stays"} <= set(named)


def test_parameters_are_remembered_with_their_node():
    found = Seen()
    found.add_graph(Graph("ros2", (Node("/cam/driver", "one"),), parameters={"/cam/driver": {"exposure": "20"}}))
    found.add_graph(AFTER)
    there = Subject(EntityKind.PARAMETER, "/cam/driver/exposure", "one")
    assert there in found.subjects(World())
    text = "kind: reference\nname: p\nconstraints: [{parameter: /cam/driver/exposure, value: 10..40}]"
    reference = load_reference([GivenText("p.yaml", text.encode())], BY_KEY)
    assert not unmatched(reference, found.subjects(World()))
