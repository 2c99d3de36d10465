"""What is remembered of what is gone stays small, however long a watch lasts."""

import gc

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.join.session import Session
from roslens.live.system.world import FORGET_GONE_S, MOST_SURPLUS, SURPLUS_S
from roslens.live.window.newest import MOST_GONE, keep_newest
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Moments, Tally
from roslens.model.wire import VERSION, Frame

SWEEP_S = 30.0
"""How often a watch lets go."""
REFERENCE = "kind: reference\nname: r\nconstraints:\n  - {topic: /expected, rate: 5..8 Hz}\n"


def test_what_was_put_first_goes_first():
    kept = dict.fromkeys("abcd", 1)
    kept.pop("a")
    kept["a"] = 2
    keep_newest(kept, 2)
    assert kept == {"d": 1, "a": 2}
    keep_newest(kept, 5)
    assert kept == {"d": 1, "a": 2}


def test_a_watch_forgets_what_came_and_went_but_not_what_is_expected():
    session = Session(load_reference([GivenText("r.yaml", REFERENCE.encode())], BY_KEY), start=0.0)
    world = session.monitor.world
    many = MOST_GONE + 200
    for number in range(many):
        names = ["/stays", f"/tool_{number}"] + (["/expected"] if number == 0 else [])
        ends = [Endpoint(name, Role.PUBLISHER, name) for name in names]
        graph = Graph("ros2", tuple(Node(name, "base", 7) for name in names), tuple(ends), ("base",))
        samples = [Sample(EntityId(EntityKind.NODE, name), float(number), {"cpu": 1.0}) for name in names]
        session.take([Frame(VERSION, "base/ros2", number, float(number), [], samples, [], graph)])
        session.look(float(number))
    session.look(many + 1000.0)
    tools = [name for name in world.topics if name.startswith("/tool_")]
    # The newest is there still; it has not gone.
    assert len(tools) <= MOST_GONE + 1
    assert f"/tool_{many - 1}" in tools
    assert {"/stays", "/expected"} <= set(world.topics)
    read = {entity.name for entity, _ in session.readings(many + 1000.0) if entity.kind is EntityKind.TOPIC}
    assert {name for name in read if name.startswith("/tool_")} <= {f"/tool_{many - 1}"}
    assert "/stays" in read
    assert len([one for one in world.sampled if one.name.startswith("/tool_")]) <= 301


def test_a_watch_forgets_topics_that_only_a_pattern_judges():
    """A pattern that matches everything matches what tools of the command line leave behind, too."""
    every = REFERENCE + "  - {topic: '/**', rate: '>= 5 Hz'}\n"
    session = Session(load_reference([GivenText("r.yaml", every.encode())], BY_KEY), start=0.0)
    world = session.monitor.world
    many = MOST_GONE + 200
    for number in range(many):
        names = ["/stays", f"/tool_{number}"] + (["/expected"] if number == 0 else [])
        ends = [Endpoint(name, Role.PUBLISHER, name) for name in names]
        graph = Graph("ros2", tuple(Node(name, "base", 7) for name in names), tuple(ends), ("base",))
        session.take([Frame(VERSION, "base/ros2", number, float(number), [], [], [], graph)])
        session.look(float(number))
    session.look(many + 1000.0)
    tools = [name for name in world.topics if name.startswith("/tool_")]
    assert len(tools) <= MOST_GONE + 1
    assert f"/tool_{many - 2}" in tools
    assert {"/stays", "/expected"} <= set(world.topics)
    assert len([one for one in session.monitor.standing() if one.entity.name.startswith("/tool_")]) == len(tools)
    assert "/tool_0" not in str(session.tree(many + 1000.0))


@pytest.mark.parametrize("reports", [1, 2])
def test_a_watch_forgets_connections_that_no_graph_had_but_not_what_is_judged(reports):
    """A tool that ends at once was counted, and is in no graph."""
    session = Session(load_reference([GivenText("r.yaml", REFERENCE.encode())], BY_KEY), start=0.0)
    world = session.monitor.world
    many = MOST_GONE + 700
    for number in range(many):
        names = [f"/tool_{number}"] + (["/expected"] if number == 0 else [])
        for report in range(reports):
            now = number + 0.4 * report + 0.4
            once = Moments(1, 0.15, 0.15**2, 0.15, 0.15)
            tallies = [Tally(name, f"{name}_node", "", now - 0.15, now, 1, 100, now, now, once) for name in names]
            session.take([Frame(VERSION, "base/agent", reports * number + report, now, tallies)])
            session.look(now)
    session.look(many + 1.0)
    tools = {topic for topic, _, _ in world.connections if topic.startswith("/tool_")}
    assert f"/tool_{many - 1}" in tools
    assert len(tools) <= MOST_SURPLUS + SURPLUS_S + SWEEP_S + 1
    assert "/expected" in {topic for topic, _, _ in world.connections}
    assert len(session.monitor._checks.presences.existing) <= 3 * (len(tools) + 1)


def test_topics_whose_connections_are_remembered_count_among_what_is_gone():
    session = Session(load_reference([GivenText("r.yaml", REFERENCE.encode())], BY_KEY), start=0.0)
    once = Moments(1, 0.15, 0.15**2, 0.15, 0.15)
    many = 3 * MOST_GONE
    for number in range(many):
        name, now = f"/tool_{number}", float(number + 1)
        graph = Graph("ros2", (Node(name, "base", 7),), (Endpoint(name, Role.PUBLISHER, name),), ("base",))
        tallies = [Tally(name, name, "", now - 0.15, now, 1, 100, now, now, once)]
        session.take([Frame(VERSION, "base/ros2", number, now, tallies, [], [], graph)])
        session.look(now)
    world = session.monitor.world
    assert len(world.connections) <= MOST_SURPLUS + SURPLUS_S + SWEEP_S + 1
    remembered = [name for name in world.topics if name.startswith("/tool_")]
    assert len(remembered) <= max(MOST_GONE, FORGET_GONE_S) + 2 * SWEEP_S + 1


def parts_alive():
    """Return the parts of every tree in this process, as sessions of other tests may live on."""
    return [one for one in gc.get_objects() if type(one).__name__ == "_Part"]


def test_a_tree_that_is_replaced_is_freed_at_once():
    """Were it freed by the collector of cycles alone, a robot with tools that come and go would hold many of them."""
    session = Session(load_reference([GivenText("r.yaml", REFERENCE.encode())], BY_KEY), start=0.0)
    gc.collect()
    others = {id(one): one for one in parts_alive()}
    gc.disable()
    try:
        for number in range(20):
            names = ["/stays", f"/tool_{number}"]
            ends = tuple(Endpoint(name, Role.PUBLISHER, name) for name in names)
            graph = Graph("ros2", tuple(Node(name, "base", 7) for name in names), ends, ("base",))
            session.take([Frame(VERSION, "base/ros2", number, float(number), [], [], [], graph)])
            session.look(float(number))
            session.tree(float(number))
        parts = sum(id(one) not in others for one in parts_alive())
    finally:
        gc.enable()
    shown = len(session.monitor.world.topics) + len(names) + len(session.monitor.world.graph.nodes) + 1
    assert 0 < parts <= 2 * shown
