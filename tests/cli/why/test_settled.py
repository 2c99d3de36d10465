"""How long a running system is looked at: shorter where what is asked about is there, on a clock of the test."""

import pytest

from roslens.cli.why.settled import ABSENT_S, THERE_S, Settled
from roslens.model.entity import EntityId
from roslens.model.graph import Endpoint, Graph, Node, Role


class Seen:
    """A session that sees what the test says."""

    def __init__(self):
        self.begun = True
        self.values = {}

    def readings(self, _now):
        return [(EntityId.parse(entity), values) for entity, values in self.values.items()]


class Clock:
    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


LIDAR = Endpoint("/lidar", Role.PUBLISHER, "/scan")
PLANNER = Endpoint("/planner", Role.SUBSCRIPTION, "/scan")


def graph(*ends):
    return Graph("ros2", tuple(Node(one.node) for one in ends), ends)


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def session():
    return Seen()


@pytest.fixture
def settled(session, clock):
    return Settled(session, "/scan", steady=clock)


@pytest.mark.parametrize(("ends", "after"), [((LIDAR, PLANNER), THERE_S), ((PLANNER,), ABSENT_S)])
def test_it_is_over_sooner_where_somebody_makes_it(settled, clock, ends, after):
    settled.take(graph(*ends))
    clock.now += after - 0.01
    assert not settled.over(0)
    clock.now += 0.02
    assert settled.over(0)


def test_whoever_comes_begins_it_anew_and_a_graph_that_is_the_same_does_not(settled, clock):
    settled.take(graph(PLANNER))
    clock.now += ABSENT_S + 0.1
    settled.take(graph(PLANNER, LIDAR))
    assert not settled.over(0)
    clock.now += THERE_S + 0.1
    settled.take(graph(PLANNER, LIDAR))
    assert settled.over(0)


def test_it_is_never_over_while_observers_start_or_nobody_is_seen(settled, session, clock):
    settled.take(None)
    settled.take(graph())
    clock.now += 60
    assert not settled.over(0)
    settled.take(graph(LIDAR))
    clock.now += 60
    session.begun = False
    assert not settled.over(0)
    session.begun = True
    assert settled.over(0)


def test_what_is_counted_and_silent_is_waited_for(settled, session, clock):
    settled.take(graph(LIDAR))
    session.values = {"topic:/scan": {"rate": 0.0}}
    clock.now += 60
    assert not settled.over(0)
    session.values = {"topic:/scan": {"rate": 3.0}}
    assert settled.over(0)
