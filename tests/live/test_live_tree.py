"""The tree of which only what changed is made anew is the tree made from scratch, whatever happened before."""

from __future__ import annotations

from random import Random

import msgspec
import pytest
from live.random_traffic import reported

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.monitor import Monitor
from roslens.live.system.live_tree import LiveTree
from roslens.live.system.tree import SystemView
from roslens.live.window.observer_status import ObserverStatus
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Process, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Observer
from roslens.model.verdict import State

REFERENCE = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {topic: /a, rate: "18..22 Hz", for: 0.2 s}
  - {topic: /b, largest_gap: "<= 0.1 s"}
  - {node: /talker, cpu: "<= 50 %"}
  - {host: base, cpu: "<= 80 %"}
  - {connection: "/talker > /a > *", latency: "<= 20 ms"}
  - {service: /add, response_time_max: "<= 100 ms"}
expected:
  nodes: [/talker, /listener]
"""
OTHER = REFERENCE.replace("18..22", "5..50").replace("<= 50 %", "<= 5 %")
SECONDS = 9.0
TOPICS, NODES = ("/a", "/b", "/c"), ("/talker", "/second", "/listener", "")
ADD = EntityId(EntityKind.SERVICE, "/add")


def reference(text: str):
    text = text.partition("expected:")[0]
    return load_reference([GivenText("rover.yaml", text.encode())], BY_KEY)


def graph(draw: Random) -> Graph:
    """Return who is there, each with a chance."""
    names = sorted(name for name in NODES[:3] if draw.random() < 0.8)
    nodes = tuple(Node(name, draw.choice(["base", "arm", ""]), 7) for name in names)
    ends = {
        Endpoint(name, draw.choice([Role.PUBLISHER, Role.SUBSCRIPTION]), topic, draw.choice(["x/msg/X", "x/msg/Y"]))
        for name in names
        for topic in TOPICS
        if draw.random() < 0.5
    }
    ends |= {Endpoint(name, Role.SERVICE_SERVER, "/add", "x/srv/Add") for name in names if draw.random() < 0.4}
    order = sorted(ends, key=lambda one: (one.node, one.role.value, one.name, one.type))
    return Graph("ros2", nodes, tuple(order), processes=(Process("base", 7, "/usr/bin/talker --fast"),))


def history(draw: Random):
    """Return what happens when: calls of a monitor, the same for every monitor that is given them."""
    found = []
    for number in range(draw.randint(1, 4)):
        publisher, observer = draw.choice(NODES), draw.choice([Observer.INSIDE, Observer.TAP])
        topic, subscriber = draw.choice(TOPICS), draw.choice(["", "/listener", "/second"])
        observer_status = draw.choice(["", "", f"base/{number % 2}"])
        for time, tally in reported(draw, publisher, observer, SECONDS * draw.choice([0.3, 1.0])):
            tally = msgspec.structs.replace(tally, topic=topic, subscriber=subscriber)
            found.append((time, number, "tally", (tally, observer_status)))
    for _ in range(draw.randint(2, 8)):
        entity = draw.choice([EntityId(EntityKind.NODE, "/talker"), EntityId(EntityKind.HOST, "base"), ADD])
        key = "response_time_max" if entity is ADD else "cpu"
        begun = draw.random() * SECONDS
        for step in range(draw.randint(1, 12)):
            time = begun + step
            found.append((time, 20, "sample", Sample(entity, time, {key: draw.choice([0.01, 40.0, 90.0])})))
    for _ in range(draw.randint(0, 5)):
        found.append((draw.random() * SECONDS, 30, "graph", graph(draw)))
    if draw.random() < 0.3:
        change = draw.choice([Change.VANISHED, Change.RESTARTED])
        time = draw.random() * SECONDS
        found.append((time, 31, "event", Event(time, change, "node:/talker")))
    if draw.random() < 0.2:
        found.append((draw.random() * SECONDS, 32, "jump", None))
    if draw.random() < 0.2:
        found.append((draw.random() * SECONDS, 33, "reference", OTHER))
    return sorted(found, key=lambda one: one[:2])


class Watched:
    """A monitor that is given a history."""

    def __init__(self) -> None:
        self.monitor = Monitor(reference(REFERENCE), start=0.0)

    def observer_status(self, name: str, time: float) -> ObserverStatus | None:
        return self.monitor.take_report(name, time) if name else None

    def take(self, time: float, what: str, value) -> None:
        monitor = self.monitor
        if what == "tally":
            tally, name = value
            monitor.add_tally(tally, self.observer_status(name, time))
        elif what == "sample":
            monitor.add_sample(value)
        elif what == "graph":
            monitor.add_graph(value, time)
        elif what == "event":
            monitor.add_event(value)
        elif what == "jump":
            monitor.clock_jumped(time)
        else:
            monitor.replace_reference(reference(value))

    def from_scratch(self, now: float):
        self.monitor.standing()
        return LiveTree(self.monitor.world).view(self.monitor._standing(), now)


def held(seed: int) -> None:
    """Hold a tree that is kept against one from scratch at every look."""
    draw = Random(seed)
    kept, plain = Watched(), Watched()
    events, now = history(draw), 0.0
    while now < SECONDS + 3:
        now += draw.choice([0.05, 0.25, 0.25, 1.1])
        while events and events[0][0] <= now:
            time, _, what, value = events.pop(0)
            kept.take(time, what, value)
            plain.take(time, what, value)
        kept.monitor.tick(now)
        plain.monitor.tick(now)
        if draw.random() < 0.7:
            expected = plain.from_scratch(now)
            found = kept.monitor.tree(now)
            assert msgspec.to_builtins(found) == msgspec.to_builtins(expected), f"seed {seed} at {now:.2f} s"


@pytest.mark.parametrize("seed", range(25))
def test_it_is_the_tree_made_from_scratch(seed: int) -> None:
    held(seed)


def test_what_did_not_change_is_the_same_object() -> None:
    watched = Watched()
    watched.take(0.5, "graph", Graph("ros2", (Node("/talker", "base"), Node("/other", "arm"))))
    cpu = EntityId(EntityKind.NODE, "/talker")
    watched.take(1.0, "sample", Sample(cpu, 1.0, {"cpu": 20.0}))
    watched.monitor.tick(1.0)
    first = hosts(watched, 1.0)
    assert hosts(watched, 1.1)["base"] is first["base"]
    watched.take(1.2, "sample", Sample(cpu, 1.2, {"cpu": 90.0}))
    watched.monitor.tick(1.2)
    then = hosts(watched, 1.2)
    assert then["arm"] is first["arm"]
    assert then["base"] is not first["base"]
    assert then["base"].children[0].values == {"cpu": 90.0}
    assert then["base"].worst is State.HIGH


def hosts(watched: Watched, now: float) -> dict[str, SystemView]:
    return {one.name: one for one in watched.monitor.tree(now).children}


@pytest.mark.nightly
@pytest.mark.parametrize("hundred", range(10, 30))
def test_wide_search(hundred: int) -> None:
    for seed in range(100 * hundred, 100 * hundred + 100):
        held(seed)
