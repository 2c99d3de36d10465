"""Two nodes of one name are seen, named with both processes, and alarm without any constraint."""

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.judge.reference.expectation import Reference
from roslens.live.join.session import Session
from roslens.live.standing.twins import LASTING_S, UNPROVEN_S
from roslens.live.window.signals import BY_KEY
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Process, Role
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.verdict import State
from roslens.model.wire import VERSION, Frame

A, B = "010f5a5a0b000000aaaaaaaa", "010f5a5a16000000bbbbbbbb"
"""Contexts of the processes 11 and 22 on one host."""


def reference(*constraints):
    text = "kind: reference\nname: r\nconstraints:\n" + "".join(f"  - {one}\n" for one in constraints)
    return load_reference([GivenText("r.yaml", text.encode())], BY_KEY)


def ends(node, *contexts):
    found = []
    for context in contexts:
        found.append(Endpoint(node, Role.PUBLISHER, "/beat", "std_msgs/msg/Header", gid=context + "00000103"))
        found.append(Endpoint(node, Role.PUBLISHER, "/rosout", gid=context + "00000203"))
    return found


def graph(*contexts, pids=(11, 22), node="/twin"):
    processes = tuple(Process("robot", pid, f"python3 twin.py {pid}") for pid in pids)
    return Graph("ros2", (Node(node, "robot"),), tuple(ends(node, *contexts)), ("robot",), processes)


class Watch:
    def __init__(self, *constraints):
        self.session = Session(reference(*constraints) if constraints else Reference("r"), start=0.0)
        self.now = 0.0
        self.states = {}

    def graph(self, graph, *events):
        self.session.take([Frame(VERSION, "robot/ros2", 0, self.now, graph=graph, events=list(events))])

    def until(self, time, *publishers):
        """Look every tenth of a second; ``publishers`` each send 10 Hz in between."""
        while self.now < time - 1e-6:
            self.now = round(self.now + 0.1, 6)
            frame = Frame(VERSION, "robot/ros2", 0, self.now, list(publishers and sent(self.now, publishers)))
            self.session.take([frame])
            for one in self.session.look(self.now).changes:
                self.states[str(one.entity), one.expectation] = one

    def state(self, entity, expectation):
        return self.states[entity, expectation].state if (entity, expectation) in self.states else None


def sent(now, publishers):
    """What an observer makes of the counters of several nodes of one name: one tally, their messages added up."""
    first = now - 0.1
    times = sorted(first + 0.1 * (number + 0.5) / len(publishers) for number in range(len(publishers)))
    period = Moments(1, 0.1, 0.01, 0.1, 0.1) if len(publishers) == 1 else Moments()
    yield Tally("/beat", "/twin", "", first, now, len(times), -1, times[0], times[-1], period, observer=Observer.INSIDE)


def test_a_node_that_was_started_twice_alarms_without_a_constraint():
    watch = Watch()
    watch.graph(graph(A))
    watch.until(6)
    watch.graph(graph(A, B))
    watch.until(6 + LASTING_S - 0.5)
    assert watch.state("node:/twin", "started_twice") is None, "it may be on its way"
    watch.until(6 + LASTING_S + 0.5)
    verdict = watch.states["node:/twin", "started_twice"]
    assert (verdict.state, verdict.value) == (State.HIGH, 2)
    assert verdict.evidence == "/twin is there 2 times: process 11 on robot, process 22 on robot"
    watch.graph(graph(A, pids=(11,)), Event(watch.now, Change.VANISHED, "process:robot/22"))
    watch.until(12)
    assert watch.state("node:/twin", "started_twice") is State.OK


def test_publishers_rate_and_at_most_one_count_nodes_and_not_names():
    watch = Watch(
        "{topic: /beat, id: rate, rate: 8..12 Hz}", "{topic: /beat, id: publishers, publishers: 1}",
        '{node: "/**", id: once, expected: at most one}',
    )  # fmt: skip
    watch.graph(graph(A))
    watch.until(8, "a")
    assert {watch.state("topic:/beat", "r.rate.rate"), watch.state("topic:/beat", "r.publishers.publishers")} == {
        State.OK
    }
    assert watch.state("node:/**", "r.once.presence") is State.OK
    watch.graph(graph(A, B))
    watch.until(12, "a", "b")
    assert watch.state("topic:/beat", "r.rate.rate") is State.HIGH
    standing = {one.expectation: one for one in watch.session.monitor.standing()}
    assert round(standing["r.rate.rate"].value, 6) == 20
    assert watch.states["topic:/beat", "r.publishers.publishers"].value == 2
    assert watch.states["node:/**", "r.once.presence"].evidence.startswith(
        "/twin is there 2 times: process 11 on robot"
    )
    assert watch.state("node:/twin", "started_twice") is None, "it was asked for, and is told once"


def test_a_node_that_is_started_again_beside_what_the_middleware_still_remembers_is_there_once():
    watch = Watch('{node: "/**", id: once, expected: at most one}')
    watch.graph(graph(A))
    watch.until(6)
    watch.graph(graph(A, B), Event(6.0, Change.VANISHED, "process:robot/11", "", "signal 9"))
    watch.until(40)
    assert (watch.state("node:/**", "r.once.presence"), watch.state("node:/twin", "started_twice")) == (State.OK, None)


def test_a_participant_whose_process_nobody_sees_counts_when_its_lease_must_be_over():
    watch = Watch()
    watch.graph(Graph("ros2", (Node("/twin"),), tuple(ends("/twin", A, B))))
    watch.until(UNPROVEN_S - 1)
    assert watch.state("node:/twin", "started_twice") is None
    watch.until(UNPROVEN_S + 1)
    assert watch.state("node:/twin", "started_twice") is State.HIGH


def test_hidden_nodes_of_tools_are_there_once_a_host():
    watch = Watch()
    watch.graph(graph(A, B, node="/_ros2cli_daemon_0"))
    watch.until(60)
    assert not watch.states
