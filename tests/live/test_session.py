import msgspec
import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.join.session import BEGIN_S, Session, Step, run
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import BY_GID, Moments, Observer, Tally
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
        report=steps.append,
    )
    assert [one.what for step in steps for one in step.failures] == ["second", "first"]
    assert all(source.closed for source in sources)


class Starting:
    """A source whose polls take a quarter of a second each, and that tells a graph once it has started."""

    def __init__(self, clock, starts, graph):
        self.clock, self.starts, self.graph = clock, starts, graph
        self.seeing = False

    def poll(self, seconds):
        self.clock[0] += 0.25
        if self.clock[0] < self.starts:
            return []
        graph, self.seeing = None if self.seeing else self.graph, True
        return [frame(self.clock[0], graph=graph, looked=self.clock[0])]

    def close(self):
        pass


ALWAYS = """
kind: reference
name: rover
defaults: {grace: 2 s}
constraints:
  - {node: /lidar, expected: always}
  - {topic: /scan, rate: 8..12 Hz}
  - {topic: /map, expected: always}
  - {host: base, cpu: <= 50 %}
"""
NEVER_SEEN = {"topic:/scan", "topic:/map", "host:base"}


@pytest.mark.parametrize("starts", [0.25, 4.0, 25.0, 1000.0])
@pytest.mark.parametrize("there", [True, False])
def test_grace_counts_from_when_observers_see(starts, there):
    clock, reported = [0.0], []
    session = Session(load_reference([GivenText("rover.yaml", ALWAYS.encode())], BY_KEY), start=0.0)
    source = Starting(clock, starts, Graph("ros2", nodes=(Node("/lidar"),) if there else ()))
    run(session, [source], wall=lambda: clock[0], stopped=lambda now: now > 70.0, report=reported.append)
    bad = {str(one.entity): step.time for step in reported for one in step.changes if one.state.bad}
    assert bad.keys() == NEVER_SEEN if there and starts < 70.0 else {*NEVER_SEEN, "node:/lidar"}
    # Who never says anything is not waited for for ever.
    begins = min(starts, BEGIN_S)
    assert all(begins + 2 <= time <= begins + 3 for time in bad.values()), bad


class Watcher(Scripted):
    """A source that remembers which processes it was notified of."""

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
        report=steps.append,
    )
    assert watcher.named == [("base", {7}), ("arm", {8}), ("base", {9})]


def test_sources_are_closed_whatever_happens(session):
    source = Scripted([])

    def reported(_):
        raise RuntimeError

    with pytest.raises(RuntimeError):
        run(session, [source], wall=lambda: 0.0, stopped=lambda _: False, report=reported)
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
    reported = [(str(one.entity), one.state, one.cause) for step in steps for one in step.changes if one.state.bad]
    assert reported == [("topic:/scan", State.LOW, ""), ("node:/a", State.HIGH, "")]
    found = [(str(one.entity), one.cause) for step in steps for one in step.causes]
    assert found == [("topic:/scan", "node:/a")]


GID = "010fbbbb070000000000000000001203"
ENDS = (
    Endpoint("/a", Role.PUBLISHER, "/scan", gid=GID),
    Endpoint("/b", Role.SUBSCRIPTION, "/scan", gid="010faaaa0700000000000000000012ff"),
)


def counted(second, *, host="arm", sender="arm/agent", place="arm's", publisher=BY_GID + GID, latency=0.001):
    moments = Moments(10, 10 * latency, 10 * latency * latency, latency, latency)
    reported = msgspec.structs.replace(
        tally(second), publisher=publisher, subscriber="/b", latency=moments, host=host, observer=Observer.INSIDE
    )
    return frame(second + 1.0, sender=sender, tallies=[reported], counted_at=place)


def clock(host, offset, time):
    return Sample(EntityId(EntityKind.HOST, host), time, {"clock_offset": offset, "clock_bound": 0.0001})


def connections(session, time):
    return {str(one): values for one, values in session.readings(time) if one.kind is EntityKind.CONNECTION}


def test_what_an_agent_counted_is_told_with_the_name_of_its_publisher_and_by_one_clock(session):
    session.take([frame(0.0, graph=Graph("ros2", (Node("/a", "base", 7), Node("/b", "arm", 7)), ENDS))])
    for second in range(4):
        session.look(second + 0.5)
        clocks = [clock("base", 0.0, second + 0.5), clock("arm", 0.25, second + 0.5)]
        session.take([frame(second + 0.5, sender="arm/agent", samples=clocks), counted(float(second), latency=0.251)])
        session.look(second + 1.0)
    found = connections(session, 4.0)
    assert set(found) == {"connection:/a > /scan > /b"}
    assert found["connection:/a > /scan > /b"]["latency"] == pytest.approx(0.001)
    assert found["connection:/a > /scan > /b"]["rate"] == pytest.approx(10)


def test_a_latency_between_hosts_whose_clocks_nobody_knows_is_unknown(session):
    session.take([frame(0.0, graph=Graph("ros2", (Node("/a", "base", 7), Node("/b", "arm", 7)), ENDS))])
    session.look(0.0)
    session.take([counted(0.0)])
    session.look(1.0)
    (values,) = connections(session, 1.0).values()
    assert "latency" not in values
    assert "rate" in values


def test_a_publisher_that_is_met_late_is_named_all_the_same(session):
    session.look(0.0)
    session.take([counted(0.0)])
    session.look(0.5)
    assert connections(session, 0.5) == {}
    session.take([frame(0.6, graph=Graph("ros2", (Node("/a"), Node("/b")), ENDS))])
    session.look(0.6)
    session.look(1.0)
    assert set(connections(session, 1.0)) == {"connection:/a > /scan > /b"}


def test_no_node_is_ever_called_by_its_identifier(session):
    session.look(0.0)
    session.take([counted(0.0)])
    for time in (2.0, 4.0, 6.0):
        session.look(time)
    assert set(connections(session, 6.0)) == {"connection:? > /scan > /b"}


def test_what_two_read_from_the_same_counters_is_counted_once(session):
    session.take([frame(0.0, graph=Graph("ros2", (Node("/a", "base", 7), Node("/b", "base", 8)), ENDS))])
    session.look(0.0)
    for second in range(4):
        own = counted(float(second), host="base", sender="base/ros2", place="", publisher="/a")
        beside = frame(second + 1.0, sender="base/monitor", counted_at="base's")
        others = [counted(float(second), host=name, sender=f"{name}/agent", place="base's") for name in ("base", "x")]
        session.take([own, beside, *others])
        session.look(second + 1.0)
    found = connections(session, 4.0)
    assert found["connection:/a > /scan > /b"]["rate"] == pytest.approx(10)
    assert len(found) == 1


def test_a_service_is_told_with_the_values_of_all_hosts(session):
    add = EntityId(EntityKind.SERVICE, "/add")
    for second in range(3):
        session.take(
            [
                frame(1.0, sender="arm/agent", samples=[Sample(add, 9e9, {"calls": 2.0})], counted_at="arm's"),
                frame(1.0, sender="base/agent", samples=[Sample(add, 1.0, {"client_calls": 2.0})], counted_at="base's"),
            ]
        )
        session.look(second + 1.0)
    assert dict(session.readings(3.0))[add] == {"calls": 2.0, "client_calls": 2.0}


def test_a_service_of_another_domain_is_left_out(session):
    ends = (Endpoint("/a", Role.PUBLISHER, "/scan", gid="010f"), Endpoint("/a", Role.SERVICE_SERVER, "/add"))
    services = [Sample(EntityId(EntityKind.SERVICE, name), 1.0, {"calls": 2.0}) for name in ("/add", "/elsewhere")]
    session.take(
        [
            frame(1.0, graph=Graph("ros2", (Node("/a", "base", 7),), ends)),
            frame(1.0, sender="arm/agent", samples=services, counted_at="arm's"),
        ]
    )
    session.look(1.0)
    assert {str(entity) for entity, _ in session.readings(1.0) if entity.kind is EntityKind.SERVICE} == {"service:/add"}


def test_the_cause_of_a_service_that_is_not_called_is_its_server_that_died():
    reference = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {service: /add, calls: ">= 1 Hz"}
  - {node: /server, expected: always}
"""
    session = Session(load_reference([GivenText("rover.yaml", reference.encode())], BY_KEY), start=0.0)
    add = EntityId(EntityKind.SERVICE, "/add")
    client = (
        Endpoint("/client", Role.PUBLISHER, "/rosout", gid="010f"),
        Endpoint("/client", Role.SERVICE_CLIENT, "/add"),
    )
    with_server = Graph("ros2", (Node("/server"),), (*client, Endpoint("/server", Role.SERVICE_SERVER, "/add")))
    for second in range(1, 20):
        now, alive = float(second), second < 8
        graph = with_server if alive else Graph("ros2", (), client)
        sample = Sample(add, now, {"calls": 2.0 if alive else 0.0})
        session.take([frame(now, graph=graph, samples=[sample], looked=now)])
        if second == 8:
            session.take([frame(now, events=[Event(now, Change.VANISHED, "node:/server")], looked=now)])
        session.look(now)
    (verdict,) = [one for one in session.monitor.standing() if one.entity == add]
    assert verdict.state is State.LOW
    assert verdict.cause.startswith("node:/server")


def test_all_sources_are_asked_to_end_before_one_is_waited_for(session):
    said = []

    class Slow:
        def __init__(self, name):
            self.name = name

        def poll(self, seconds):
            return []

        def end(self):
            said.append(("end", self.name))

        def close(self):
            said.append(("close", self.name))

    run(session, [Slow("ros1"), Slow("ros2")], wall=lambda: 1.0, stopped=lambda _: True, report=lambda _: None)
    assert said == [("end", "ros1"), ("end", "ros2"), ("close", "ros1"), ("close", "ros2")]
