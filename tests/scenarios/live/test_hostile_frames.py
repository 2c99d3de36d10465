"""Whatever an agent or somebody in its place sends: named, survived, and the others are judged as before."""

from __future__ import annotations

import json
import random
import socket
import time

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.agent.link import Channel, LinkError, read_frame
from roslens.live.join.session import Session
from roslens.live.observe.listen import Listener
from roslens.live.publish.json_lines import event_line, failure_line, verdict_line
from roslens.live.publish.prometheus import prometheus_text
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Process, Role
from roslens.model.qos import Qos
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Moments, Tally
from roslens.model.verdict import State
from roslens.model.wire import VERSION, Frame, WireError, encode_frame

KEY = b"a key of more than sixteen bytes"
REFERENCE = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {topic: /scan, rate: 8..12 Hz}
  - {topic: "**", rate: ">= 0 Hz"}
  - {node: "**", cpu: <= 50 %}
  - {host: "**", cpu: <= 50 %}
"""
ODD = (
    "/with-hyphen", "/ünïcode/雪", "/" + "x" * 10_000, "/[fe80::1%eth0]:11311", "/a\nb\x00c", "/\u202egnol", "", "//",
    '/"quoted"', "/{braces}/*", "relative", "/\ud7ff", "/a > /b > /c", "gid:zz",
)  # fmt: skip


def session():
    return Session(load_reference([GivenText("rover.yaml", REFERENCE.encode())], BY_KEY), start=0.0)


def tally(topic, second, publisher="/a", subscriber="", count=10):
    gap = 1.0 / count
    period = Moments(count, 1.0, count * gap * gap, gap, gap)
    first, last = second + gap / 2, second + 1 - gap / 2
    return Tally(topic, publisher, subscriber, second, second + 1, count, 100, first, last, period)


def frame(time, sender="ros2", **given):
    return Frame(VERSION, sender, 0, time, **given)


def scan(watched):
    return {str(one.entity): one.state for one in watched.monitor.standing() if one.quantity == "rate"}["topic:/scan"]


def written(step, watched, now):
    """Everything that is said of a step, which has to be readable again."""
    lines = [verdict_line(one) for one in step.changes]
    lines += [event_line(one) for one in step.events]
    lines += [failure_line(one) for one in step.failures]
    for line in lines:
        assert "\n" not in line.strip()
        json.loads(line)
    return prometheus_text(watched.readings(now), watched.monitor.standing(), {})


@pytest.mark.parametrize("odd", ODD, ids=[ascii(one)[:20] for one in ODD])
def test_a_hostile_name_costs_nobody_else(odd):
    watched = session()
    graph = Graph(
        "ros2",
        (Node("/a", "base", 7), Node(odd, odd, 8)),
        (Endpoint("/a", Role.PUBLISHER, "/scan", "t/msg/T"), Endpoint(odd, Role.SUBSCRIPTION, odd, odd)),
        ("base", odd),
        (Process(odd, 8, odd),),
        {odd: {odd: odd}},
    )
    for second in range(6):
        now = second + 1.0
        kinds = (EntityKind.NODE, EntityKind.HOST, EntityKind.PROCESS)
        samples = [Sample(EntityId(kind, odd), now, {"cpu": 90.0, odd: 1.0}) for kind in kinds]
        events = [Event(now, Change.APPEARED, odd, odd), Event(now, Change.CHANGED, f"node:{odd}", odd)]
        tallies = [tally("/scan", float(second)), tally(odd, float(second), odd, odd)]
        failures = [Failure(odd, odd, odd, odd)]
        watched.take([frame(now, graph=graph, tallies=tallies, samples=samples, events=events, failures=failures)])
        written(watched.look(now), watched, now)
    assert scan(watched) is State.OK


def test_frames_with_a_few_other_bytes_do_not_stop_a_watch():
    rng = random.Random(11)
    watched, taken = session(), 0
    graph = Graph("ros2", (Node("/a", "base", 7),), (Endpoint("/a", Role.PUBLISHER, "/other", "t/msg/T"),), ("base",))
    for number in range(3_000):
        second = float(number // 300)
        sample = Sample(EntityId(EntityKind.HOST, "base"), second, {"cpu": 10.0})
        event = Event(second, Change.APPEARED, "node:/a")
        made = frame(
            second + 1.0, "agent", tallies=[tally("/other", second)], samples=[sample], events=[event], graph=graph
        )
        raw = bytearray(encode_frame(made)[4:])
        for _ in range(rng.randrange(1, 4)):
            raw[rng.randrange(len(raw))] = rng.randrange(256)
        try:
            odd = read_frame(bytes(raw))
        except (LinkError, WireError):
            continue
        taken += 1
        watched.take([odd])
        if number % 300 == 0:
            watched.take([frame(second + 1.0, tallies=[tally("/scan", second)])])
            watched.look(second + 1.0)
    assert taken > 300
    for second in range(10, 14):
        watched.take([frame(second + 1.0, tallies=[tally("/scan", float(second))])])
        watched.look(second + 1.0)
    assert scan(watched) is State.OK


_FLOATS = st.one_of(st.floats(-5, 20), st.sampled_from([float("nan"), float("inf"), -1e308, 1e308]))
_INTS = st.one_of(st.integers(-2, 20), st.sampled_from([-(1 << 63), (1 << 64) - 1]))
_NAMES = st.one_of(st.sampled_from(["/a", "/scan", "base", "agent"]), st.sampled_from(ODD[:-1]))
_ENTITIES = st.one_of(
    st.sampled_from(["process:", "node:", ":", "process:x", "process:base/7", "host:", "connection:/a", "topic:/scan"]),
    st.builds("{}:{}".format, st.sampled_from([kind.value for kind in EntityKind]), _NAMES),
)
_MOMENTS = st.builds(Moments, _INTS, _FLOATS, _FLOATS, _FLOATS, _FLOATS)
_FRAMES = st.builds(
    Frame,
    st.just(VERSION),
    st.sampled_from(["base/agent", "base", "/", "agent"]),
    st.integers(0, 9),
    st.floats(0, 9),
    st.lists(
        st.builds(
            Tally,
            _NAMES,
            _NAMES,
            _NAMES,
            _FLOATS,
            _FLOATS,
            _INTS,
            _INTS,
            _FLOATS,
            _FLOATS,
            _MOMENTS,
            _MOMENTS,
            _MOMENTS,
            _INTS,
            host=_NAMES,
            processing=_MOMENTS,
            longest_at=_FLOATS,
        ),
        max_size=3,
    ),
    st.lists(
        st.builds(
            Sample,
            st.builds(EntityId, st.sampled_from(EntityKind), _NAMES),
            _FLOATS,
            st.dictionaries(st.sampled_from(["cpu", "calls", "clock_offset", "clock_bound", ""]), _FLOATS),
        ),
        max_size=3,
    ),
    st.lists(st.builds(Event, _FLOATS, st.sampled_from(Change), _ENTITIES, _NAMES), max_size=3),
    st.none()
    | st.builds(
        Graph,
        st.sampled_from(["ros1", "ros2", ""]),
        st.lists(st.builds(Node, _NAMES, _NAMES, _INTS, st.just(("gid",)), _NAMES), max_size=3).map(tuple),
        st.lists(
            st.builds(
                Endpoint,
                _NAMES,
                st.sampled_from(Role),
                _NAMES,
                _NAMES,
                qos=st.none() | st.builds(Qos, depth=_INTS),
                gid=st.sampled_from(["", "zz", "010f" * 8, "010f"]),
            ),
            max_size=3,
        ).map(tuple),
        st.lists(_NAMES, max_size=2).map(tuple),
        st.lists(st.builds(Process, _NAMES, _INTS, _NAMES, _FLOATS, inner=_INTS), max_size=3).map(tuple),
        st.dictionaries(_NAMES, st.dictionaries(_NAMES, _NAMES, max_size=2), max_size=2),
        st.dictionaries(_NAMES, st.lists(st.sampled_from(["010f", "", "zz"]), max_size=2).map(tuple), max_size=2),
    ),
    st.lists(st.builds(Failure, _NAMES, _NAMES), max_size=2),
    st.integers(-1, 3),
    st.sampled_from(["", "here", "there"]),
)


@settings(
    max_examples=150, deadline=None, phases=[Phase.explicit, Phase.reuse, Phase.generate]
)  # to shrink takes minutes
@given(st.lists(_FRAMES, min_size=1, max_size=5))
def test_whatever_knows_the_key_may_say_anything(frames):
    """Frames of the right shape, whatever stands in them, stop no watch and hide no other entity."""
    watched = session()
    for second in range(1, 5):
        now = float(second)
        for one in frames:
            try:
                watched.take([read_frame(encode_frame(one)[4:])])
            except LinkError as error:
                assert "expected" in str(error)  # noqa: PT017 - every message is fine, a crash is not
        watched.take([frame(now, "b/ros2", tallies=[tally("/mine", now - 1)])])
        written(watched.look(now), watched, now)
        watched.tree(now)
    assert "topic:/mine" in {str(one.entity) for one in watched.monitor.standing()}


@pytest.mark.heavy
def test_a_hundred_thousand_pieces_of_garbage_are_refused_in_words():
    rng = random.Random(7)
    for number in range(100_000):
        piece = rng.randbytes(rng.randrange(60))
        if number % 2:
            piece = len(piece).to_bytes(4, "big") + piece
        fresh = Channel(KEY, accepting=True)
        try:
            list(fresh.feed(piece))
        except LinkError as error:
            assert str(error)  # noqa: PT017 - every message is fine, a crash is not
        assert not fresh.ready
        try:
            read_frame(piece)
        except (LinkError, WireError) as error:
            assert str(error)  # noqa: PT017


def test_an_agent_of_another_version_is_named_and_hung_up_on():
    listener = Listener(("127.0.0.1", 0), KEY, wall=time.time, steady=time.monotonic)
    hello = bytearray(Channel(KEY, accepting=False).hello())
    hello[5] = 9
    came, end = [], time.monotonic() + 20
    try:
        with socket.create_connection(("127.0.0.1", listener.port), 5.0) as line:
            line.sendall(hello)
            while not came:
                assert time.monotonic() < end
                came += listener.poll(0.01)
            line.settimeout(5.0)
            while line.recv(4096):
                assert time.monotonic() < end
    finally:
        listener.close()
    assert [one.what for one in came if isinstance(one, Failure) and "version 9, expected 3" in one.what]
