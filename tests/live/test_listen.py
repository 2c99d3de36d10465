"""Agents and a monitor over loopback, each step taken by the test."""

import socket
import time
from itertools import pairwise

import pytest

from roslens.live.agent.host import HostSampler
from roslens.live.agent.link import Channel
from roslens.live.agent.processes import ProcessSampler
from roslens.live.agent.work import Agent
from roslens.live.observe.listen import MOST_UNPROVEN, MOST_UNPROVEN_OF_A_HOST, PROOF_S, SILENT_S, Listener
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Tally
from roslens.model.wire import Frame

pytestmark = pytest.mark.timed

KEY = b"a key of more than sixteen bytes"
OTHER_KEY = b"another key of thirty-two bytes."


class Clock:
    def __init__(self):
        self.ahead = 0.0

    def __call__(self):
        return time.monotonic() + self.ahead


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def listener(clock):
    made = Listener(("127.0.0.1", 0), KEY, wall=clock, steady=clock)
    yield made
    made.close()


@pytest.fixture
def agent_of(tmp_path):
    made = []
    (tmp_path / "proc").mkdir()
    (tmp_path / "proc" / "loadavg").write_text("0.5 0 0 1/1 1")

    def make(port, *, key=KEY, ahead=0.0, name="base", said=None, **more):
        clock = Clock()
        clock.ahead = ahead
        host = HostSampler(name, proc=tmp_path / "proc", sys=tmp_path)
        processes = ProcessSampler(name, proc=tmp_path / "proc")
        made.append(
            Agent(
                name,
                host,
                processes,
                address=("127.0.0.1", port),
                key=key,
                wall=clock,
                steady=time.monotonic,
                period_s=0.05,
                say=(said if said is not None else []).append,
                **more,
            )
        )
        return made[-1]

    yield make
    for one in made:
        one.close()


def until(listener, agents, done, *, seconds=20.0):
    """Step both sides until ``done(records)``; returns the records."""
    records, end = [], time.monotonic() + seconds
    while not done(records):
        assert time.monotonic() < end, records
        for agent in agents:
            agent.step()
        records += listener.poll(0.01)
    return records


def frames(records):
    return [one for one in records if isinstance(one, Frame)]


def failures(records):
    return [one.what for one in records if isinstance(one, Failure)]


def samples(records):
    return [sample for frame in frames(records) for sample in frame.samples]


def test_samples_arrive(listener, agent_of):
    records = until(listener, [agent_of(listener.port)], lambda records: len(samples(records)) >= 3)
    assert {str(sample.entity) for sample in samples(records)} == {"host:base"}
    assert samples(records)[0].values["load"] == 0.5
    assert [frame.sequence for frame in frames(records)] == list(range(len(frames(records))))
    assert listener.agents() == ("base/agent",)


def test_the_clock_of_an_agent_is_known(listener, agent_of):
    agent = agent_of(listener.port, ahead=0.25)

    def known(records):
        return any("clock_offset" in sample.values for sample in samples(records))

    values = samples(until(listener, [agent], known))[-1].values
    assert values["clock_offset"] == pytest.approx(0.25, abs=0.02)
    assert 0 <= values["clock_bound"] < 0.05


def test_a_wrong_key_is_named_on_both_sides(listener, agent_of):
    said = []
    agent = agent_of(listener.port, key=b"another key of thirty-two bytes.", said=said)
    records = until(listener, [agent], lambda records: failures(records) and said)
    assert "the same --key-file" in failures(records)[0]
    assert "the same --key-file" in said[0]
    assert not frames(records)


def test_a_wrong_key_is_told_once_however_often_it_is_tried(listener, agent_of):
    reported = []
    for _ in range(2):
        said = []
        agent = agent_of(listener.port, key=b"another key of thirty-two bytes.", said=said)
        records = until(listener, [agent], lambda records, said=said: failures(records) and said)
        reported += failures(records)
    assert len(reported) == 2
    assert len(set(reported)) == 1


def test_garbage_does_not_disturb_the_others(listener, agent_of):
    agent = agent_of(listener.port)
    with socket.create_connection(("127.0.0.1", listener.port)) as stranger:
        stranger.sendall(b"GET / HTTP/1.1\r\n\r\n" * 10)
        records = until(listener, [agent], lambda records: failures(records) and len(samples(records)) >= 2)
    assert "expected a roslens agent" in failures(records)[0]
    assert listener.agents() == ("base/agent",)


def test_a_thousand_connections_of_garbage_are_one_row(listener, agent_of):
    agent, came = agent_of(listener.port), []
    for number in range(1_000):
        with socket.create_connection(("127.0.0.1", listener.port)) as stranger:
            stranger.sendall(b"%05d garbage, and never the same twice, longer than a greeting may be" % number * 2)
            came += listener.poll(0.0) + listener.poll(0.0)
    came += until(listener, [agent], lambda records: samples(records))
    assert [one for one in failures(came) if "127.0.0.1" in one] == failures(came)
    assert len(failures(came)) == 1
    other = agent_of(listener.port, key=b"another key of thirty-two bytes.")
    assert "the same --key-file" in failures(until(listener, [other], failures))[0]


def test_frames_wait_while_the_monitor_is_away(clock, agent_of):
    first = Listener(("127.0.0.1", 0), KEY, wall=clock, steady=clock)
    port = first.port
    said = []
    agent = agent_of(port, said=said)
    seen = frames(until(first, [agent], lambda records: len(frames(records)) >= 2))
    first.close()
    end = time.monotonic() + 20
    while not any("trying again" in line for line in said):
        assert time.monotonic() < end
        agent.step()
    second = Listener(("127.0.0.1", port), KEY, wall=clock, steady=clock)
    try:
        later = frames(until(second, [agent], lambda records: len(frames(records)) >= 3))
    finally:
        second.close()
    numbers = [frame.sequence for frame in later]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    # What was on its way when the line broke may be gone; what was sampled afterwards may not.
    assert numbers[0] <= seen[-1].sequence + 4
    assert later[-1].graph is not None or any(frame.graph is not None for frame in later)


def test_an_agent_is_told_which_processes_hold_nodes(listener, agent_of):
    agent = agent_of(listener.port)
    listener.name("base", frozenset({7, 8}))
    listener.name("arm", frozenset({9}))
    until(listener, [agent], lambda _: agent._processes._named == {7, 8})
    listener.name("base", frozenset({8}))
    until(listener, [agent], lambda _: agent._processes._named == {8})


@pytest.fixture
def two_keys(clock):
    made = Listener(("127.0.0.1", 0), KEY, OTHER_KEY, wall=clock, steady=clock)
    yield made
    made.close()


def test_a_host_belongs_to_the_first_key_that_named_it(two_keys, agent_of):
    first = agent_of(two_keys.port)
    until(two_keys, [first], samples)
    second, arm = agent_of(two_keys.port, key=OTHER_KEY), agent_of(two_keys.port, key=OTHER_KEY, name="arm")
    records = until(
        two_keys, [first, second, arm], lambda records: failures(records) and "arm/agent" in two_keys.agents()
    )
    assert failures(records) == ["the connection from 127.0.0.1 knows key 2 and speaks for the host 'base'"]
    assert two_keys.agents() == ("arm/agent", "base/agent")
    # It tries again and again, and is named once; the first one goes on.
    second._wait_s = 0.0
    more = until(two_keys, [first, second], lambda records: len(samples(records)) >= 5)
    assert failures(more) == []
    assert {frame.sender for frame in frames(more)} <= {"base/agent", "arm/agent"}


def test_a_host_is_told_of_by_its_own_key_alone(two_keys, agent_of):
    until(two_keys, [agent_of(two_keys.port)], samples)
    other = agent_of(two_keys.port, key=OTHER_KEY, name="arm")
    other._host._entity = EntityId(EntityKind.HOST, "base")
    records = until(two_keys, [other], failures)
    assert failures(records) == ["the connection from 127.0.0.1 knows key 2 and speaks for the host 'base'"]
    assert not [sample for frame in frames(records) if frame.sender == "arm/agent" for sample in frame.samples]


def test_a_connection_has_one_name(listener, agent_of):
    agent = agent_of(listener.port)
    until(listener, [agent], samples)
    agent._name = "arm"
    assert "it calls itself 'arm/agent' now" in failures(until(listener, [agent], failures))[0]


class Counters:
    """Counts one message a read, and one call a sample."""

    closed = False

    def read(self, now):
        return [("here", [Tally("/scan", "gid:010f", "/planner", now - 0.15, now, 1)])]

    def calls(self, now):
        return [("here", [Sample(EntityId(EntityKind.SERVICE, "/add"), now, {"calls": 1.0})])]

    def nodes(self):
        return {7: frozenset({"/planner"})}

    def places(self):
        return ["here"]

    def failures(self):
        return []

    def close(self):
        self.closed = True


def test_what_nodes_count_is_told_several_times_a_second(listener, agent_of):
    counters = Counters()
    agent = agent_of(listener.port, counters=counters, identities=lambda: ("78fd",))

    def enough(records):
        return sum(bool(frame.tallies) for frame in frames(records)) >= 5

    found = frames(until(listener, [agent], enough))
    counted = [frame for frame in found if frame.tallies]
    assert {frame.counted_at for frame in counted} == {"here"}
    apart = [later.time - one.time for one, later in pairwise(counted)]
    assert min(apart) < 0.2
    calls = [frame for frame in found if any(str(sample.entity) == "service:/add" for sample in frame.samples)]
    assert {frame.counted_at for frame in calls} == {"here"}
    graphs = [frame.graph for frame in found if frame.graph is not None]
    assert graphs[0].identities == {"base": ("78fd",)}
    agent.close()
    assert counters.closed


def test_two_agents_on_a_host(listener, agent_of):
    agents = [agent_of(listener.port, name="base"), agent_of(listener.port, name="arm")]
    until(listener, agents, lambda _: len(listener.agents()) == 2)
    assert listener.agents() == ("arm/agent", "base/agent")


def connected(listener, many, source="127.0.0.1"):
    """Connect so often from an address, and let the listener see it."""
    made = []
    for _ in range(many):
        made.append(socket.create_connection(("127.0.0.1", listener.port), source_address=(source, 0)))
        while made[-1].getsockname() not in {line.socket.getpeername() for line in listener._lines.values()}:
            listener.poll(0.01)
    return made


@pytest.mark.parametrize("drip", [b"", b"r"])
def test_who_does_not_prove_the_key_in_time_is_hung_up_on_whatever_it_sends(listener, clock, drip):
    (stranger,) = connected(listener, 1)
    with stranger:
        stranger.sendall(drip)
        clock.ahead = PROOF_S - 1
        assert failures(listener.poll(0.05)) == []
        clock.ahead = PROOF_S + 1
        assert "it did not prove within 5 s that it knows the key" in failures(listener.poll())[0]
    assert not listener._lines


def test_an_agent_that_says_nothing_is_hung_up_on(listener, agent_of, clock):
    agent = agent_of(listener.port)
    until(listener, [agent], lambda _: listener.agents())
    clock.ahead = SILENT_S + 1
    assert any("it was silent for 10 s" in one for one in failures(listener.poll()))


def test_a_crowd_of_strangers_locks_no_agent_out(listener, agent_of):
    crowd = [one for number in range(2, 12) for one in connected(listener, 8, f"127.0.0.{number}")]
    assert len(listener._lines) <= MOST_UNPROVEN
    crowd += connected(listener, 3 * MOST_UNPROVEN_OF_A_HOST)
    assert sum(line.peer.startswith("127.0.0.1:") for line in listener._lines.values()) <= MOST_UNPROVEN_OF_A_HOST
    agent = agent_of(listener.port)
    until(listener, [agent], lambda _: listener.agents())
    for one in crowd:
        one.close()


def test_without_descriptors_nobody_is_asked_again_at_once(listener, agent_of, clock, monkeypatch):
    asked = []

    class Full:
        def accept(self):
            asked.append(clock())
            raise OSError(24, "Too many open files")

    real = listener._socket
    listener._socket, full = Full(), listener._socket
    with socket.create_connection(("127.0.0.1", real.getsockname()[1])):
        monkeypatch.setattr(
            listener._selector, "unregister", lambda _: type(listener._selector).unregister(listener._selector, full)
        )
        listener._accept()
        for _ in range(20):
            listener.poll(0.0)
    listener._socket = real
    assert len(asked) == 1
    clock.ahead = 2.0
    agent = agent_of(listener.port)
    until(listener, [agent], lambda _: listener.agents())


def test_who_connects_and_leaves_without_a_word_is_not_told_of(listener):
    (stranger,) = connected(listener, 1)
    assert stranger.recv(100)  # or closing would reset the line
    stranger.close()
    assert failures(listener.poll(1.0)) == []
    assert not listener._lines


def test_who_greets_and_leaves_is_told_of(listener):
    (stranger,) = connected(listener, 1)
    assert stranger.recv(100)
    stranger.sendall(Channel(KEY, accepting=False).hello())
    assert failures(listener.poll(1.0)) == []
    stranger.close()
    assert "it hung up before it had proven the key: give both the same --key-file" in failures(listener.poll(1.0))[0]


def test_an_agent_that_ends_lets_go_of_all(listener, agent_of):
    counters = Counters()
    agent_of(listener.port, counters=counters).run(lambda: True)
    assert counters.closed


def test_after_a_restart_a_host_belongs_to_the_first_key_that_names_it_then(clock, agent_of):
    for key in (KEY, OTHER_KEY):
        listener = Listener(("127.0.0.1", 0), KEY, OTHER_KEY, wall=clock, steady=clock)
        try:
            records = until(listener, [agent_of(listener.port, key=key)], samples)
            assert failures(records) == []
            assert listener.agents() == ("base/agent",)
        finally:
            listener.close()
