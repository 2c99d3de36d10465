import pytest

from roslens.judge.read_reference import GivenText, load_reference
from roslens.live.session import Session, Step, run
from roslens.live.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Role
from roslens.model.sample import Sample
from roslens.model.tally import Moments, Tally
from roslens.model.verdict import State
from roslens.model.wire import VERSION, Frame

REFERENCE = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {topic: /scan, rate: 8..12 Hz}
  - {node: /a, cpu: <= 50 %}
"""


@pytest.fixture
def session():
    return Session(load_reference([GivenText("rover.yaml", REFERENCE.encode())], BY_KEY), start=0.0)


def tally(second, count=10):
    gap = 1.0 / count
    period = Moments(count, 1.0, count * gap * gap, gap, gap)
    return Tally("/scan", "/a", "", second, second + 1, count, 100, second + gap / 2, second + 1 - gap / 2, period)


def frame(time, **given):
    return Frame(VERSION, given.pop("sender", "ros2"), 0, time, **given)


def test_a_rate_that_drops_is_told_once(session):
    changes = []
    for second in range(20):
        session.take([frame(second + 1.0, tallies=[tally(float(second), 10 if second < 10 else 5)])])
        changes += session.look(second + 1.0).changes
    states = [(str(one.entity), one.state) for one in changes if one.quantity == "rate"]
    assert states[-1] == ("topic:/scan", State.LOW)
    assert states.count(("topic:/scan", State.LOW)) == 1


def test_what_a_process_uses_is_judged_of_its_node(session):
    graph = Graph("ros2", (Node("/a", "base", 7),))
    sample = Sample(EntityId(EntityKind.PROCESS, "base/7"), 1.0, {"cpu": 90.0})
    session.take([frame(1.0, graph=graph), frame(1.0, sender="base/agent", samples=[sample])])
    for time in (1.0, 2.0, 3.0):
        step = session.look(time)
        later = Sample(EntityId(EntityKind.PROCESS, "base/7"), time, {"cpu": 90.0})
        session.take([frame(time, sender="base/agent", samples=[later])])
    standing = {str(one.entity): one.state for one in session.monitor.standing() if one.quantity == "cpu"}
    assert standing["node:/a"] is State.HIGH
    assert step.failures == ()
    assert dict(session.readings(3.0))[EntityId(EntityKind.NODE, "/a")]["cpu"] == 90.0


def test_the_graph_of_an_agent_does_not_replace_that_of_ros(session):
    session.take(
        [
            frame(1.0, graph=Graph("ros2", (Node("/a", "base", 7),))),
            frame(1.0, sender="base/agent", graph=Graph("", hosts=("base",))),
        ]
    )
    session.look(1.0)
    names = [node.name for host in session.tree(1.0).children for node in host.children]
    assert "/a" in names


def test_a_failure_that_is_said_again_is_told_once(session):
    failure = Failure("ros1", "no master at http://localhost:11311")
    session.take([failure, frame(1.0, failures=[failure])])
    assert session.look(1.0).failures == (failure,)
    session.take([failure])
    assert session.look(2.0).failures == ()


def test_events_are_told(session):
    event = Event(1.0, Change.APPEARED, "node:/a")
    session.take([frame(1.0, events=[event])])
    assert session.look(1.0).events == (event,)
    assert session.look(2.0).events == ()


class Scripted:
    """A source that gives one frame a poll and remembers that it was closed."""

    def __init__(self, frames):
        self.frames = list(frames)
        self.closed = False

    def poll(self, seconds):
        return [self.frames.pop(0)] if self.frames else []

    def close(self):
        self.closed = True


def test_a_run_asks_all_sources_and_closes_them(session):
    sources = [Scripted([frame(1.0), Failure("x", "first")]), Scripted([Failure("y", "second")])]
    steps: list[Step] = []
    clock = iter(range(100))
    run(
        session,
        sources,
        wall=lambda: float(next(clock)),
        stopped=lambda _: len(steps) == 3,
        told=steps.append,
    )
    assert [one.what for step in steps for one in step.failures] == ["second", "first"]
    assert all(source.closed for source in sources)


class Watcher(Scripted):
    """A source that remembers which processes it was told of."""

    def __init__(self):
        super().__init__([])
        self.named = []

    def name(self, host, pids):
        self.named.append((host, pids))


def test_who_samples_processes_is_told_which_hold_nodes(session):
    watcher = Watcher()
    graphs = [Graph("ros1", (Node("/a", "base", 7), Node("/b", "arm", 8))), Graph("ros1", (Node("/a", "base", 9),))]
    steps: list[Step] = []
    run(
        session,
        [Scripted([frame(1.0, graph=one) for one in graphs]), watcher],
        wall=lambda: 1.0,
        stopped=lambda _: len(steps) == 4,
        told=steps.append,
    )
    assert watcher.named == [("base", {7}), ("arm", {8}), ("base", {9})]


def test_sources_are_closed_whatever_happens(session):
    source = Scripted([])

    def told(_):
        raise RuntimeError

    with pytest.raises(RuntimeError):
        run(session, [source], wall=lambda: 0.0, stopped=lambda _: False, told=told)
    assert source.closed


def test_a_cause_that_is_found_later_is_told_apart_from_what_became_bad():
    text = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {topic: /scan, rate: ">= 8 Hz"}
  - {node: /a, cpu: "<= 50 %"}
"""
    session = Session(load_reference([GivenText("rover.yaml", text.encode())], BY_KEY), start=0.0)
    ends = (Endpoint("/a", Role.PUBLISHER, "/scan"),)
    session.take([frame(0.0, graph=Graph("ros2", (Node("/a", "base"),), ends))])
    steps = []
    for second in range(6):
        cpu = Sample(EntityId(EntityKind.NODE, "/a"), second + 1.0, {"cpu": 90.0 if second >= 2 else 10.0})
        session.take([frame(second + 1.0, tallies=[tally(float(second), 4)], samples=[cpu])])
        steps.append(session.look(second + 1.0))
    told = [(str(one.entity), one.state, one.cause) for step in steps for one in step.changes if one.state.bad]
    assert told == [("topic:/scan", State.LOW, ""), ("node:/a", State.HIGH, "")]
    found = [(str(one.entity), one.cause) for step in steps for one in step.causes]
    assert found == [("topic:/scan", "node:/a")]
