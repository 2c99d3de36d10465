"""Each process of a watch, hours of changes in seconds: what it keeps does not grow with how long it runs.

`tests/scenarios/live/test_soak.py` is the same in real time with real processes.
"""

import gc
import sys
from functools import partial
from types import SimpleNamespace

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.adapters.ros2.observation import Observation
from roslens.live.inside import rclpy_hook, rclpy_state, slots
from roslens.live.inside.counter_file import CounterFile
from roslens.live.inside.counters import CounterReader
from roslens.live.inside.host_counters import HostCounters
from roslens.live.inside.slots import VARIABLE
from roslens.live.join.session import Session
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Process, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Moments, Tally
from roslens.model.wire import VERSION, Frame, decode_frame, encode_frame

pytestmark = pytest.mark.heavy

STEP_S = 0.15
"""What an observer tells anew, so often."""
ROUNDS = 6_000
"""A quarter of an hour of them."""
MOST_OBJECTS = 400
"""So many objects may be more at the end than after a third of it: one for ten changes."""
START = 1_700_000_000.0


def assert_level(turn, rounds=ROUNDS, most=MOST_OBJECTS):
    """Assert that what `turn` keeps is no more at the end than after a third of the rounds."""
    before = 0
    for number in range(rounds):
        turn(number, START + number * STEP_S)
        if number == rounds // 3:
            gc.collect()
            before = sys.getallocatedblocks()
    gc.collect()
    assert sys.getallocatedblocks() - before < most


@pytest.fixture
def file(tmp_path):
    made = CounterFile(str(tmp_path / "counters"), 64)
    yield made
    made.close()


def gid_of(number):
    return f"010f78fd{number % 65_536:04x}".ljust(32, "0")


def graph(number):
    """A robot on which a tool with a name of its own comes and goes, as `ros2 topic echo` does."""
    names = ["/lidar", "/planner", f"/_ros2cli_{number // 2}"]
    ends = [Endpoint(name, Role.PUBLISHER, "/rosout", gid=gid_of(at + number // 2)) for at, name in enumerate(names)]
    ends += [
        Endpoint("/lidar", Role.PUBLISHER, "/scan", gid=gid_of(9)),
        Endpoint("/lidar", Role.SERVICE_SERVER, "/add"),
    ]
    ends += [Endpoint(names[-1], Role.SUBSCRIPTION, f"/tool{number // 2}", gid=gid_of(number // 2 + 50))]
    nodes = tuple(Node(name, "base", 7 + at) for at, name in enumerate(names))
    return Graph("ros2", nodes, tuple(sorted(ends)), ("base",), (Process("base", 7),))


class Graphs:
    """What the middleware tells, another each second."""

    unsettled = False

    def __init__(self):
        self.number = 0

    def update(self):
        return graph(self.number)

    def sweep(self, most):
        return False

    def ended(self, pid):
        return True

    def node_of(self, gid):
        return "/lidar" if gid == gid_of(9) else None

    def own(self, gid):
        return False

    def pids(self):
        return {7}


def count(file, number, now):
    """Topics and services, all of which are used all the time."""
    when = int(now * 1e9)
    if number == 0:
        file.kept = [
            file.slot(slots.PUBLISHED, b"", "/scan", "/lidar"),
            file.slot(slots.TAKEN, bytes.fromhex(gid_of(9)), "/scan", "/planner"),
            *(file.slot(kind, b"", f"/add{at}", "/lidar") for kind in (slots.ASKED, slots.REPLIED) for at in range(10)),
        ]
    for slot in file.kept:
        slot.arrived(when, when, 1000, None, 100, None)


def test_the_observer_of_ros2(file, tmp_path):
    reader, graphs = CounterReader(str(tmp_path / "counters")), Graphs()
    observation = Observation("base", graphs, reader)

    def turn(number, now):
        count(file, number, now)
        graphs.number = number
        observation.changed(now)
        observation.period(now, STEP_S)

    assert_level(turn)
    reader.close()


@pytest.mark.parametrize("beside", [False, True])
def test_the_counters_of_an_agent(file, tmp_path, beside):
    counters = HostCounters("base", {VARIABLE: str(tmp_path / "counters")}, beside=beside)

    def turn(number, now):
        count(file, number, now)
        if number % 10 == 0:
            short = CounterFile(str(tmp_path / "counters"), 2)
            short.slot(slots.PUBLISHED, b"", f"/of{number}", f"/node{number}").published(int(now * 1e9), 10)
            counters.read(now)
            short.close()
        counters.read(now + 0.01)
        counters.calls(now)
        counters.failures()

    assert_level(turn, ROUNDS // 2)
    counters.close()


def test_the_monitor():
    """What was there once is remembered to the end, so names come again here."""
    reference = "kind: reference\nname: rover\nconstraints:\n  - {topic: /scan, rate: 5..8 Hz}\n"
    session = Session(load_reference([GivenText("rover.yaml", reference.encode())], BY_KEY), start=START)

    def turn(number, now):
        tallies = [
            Tally(
                "/scan",
                "/lidar",
                end,
                now - STEP_S,
                now,
                1,
                100,
                now,
                now,
                Moments(1, STEP_S, STEP_S**2, STEP_S, STEP_S),
            )
            for end in ("", "/planner")
        ]
        samples = [
            Sample(EntityId(EntityKind.HOST, "base"), now, {"cpu": 10.0}),
            Sample(EntityId(EntityKind.SERVICE, "/add"), now, {"calls": 1.0, "response_time": 0.1}),
        ]
        number %= 200
        tool = f"node:/_ros2cli_{number // 2}"
        events = [Event(now, Change.APPEARED if number % 2 == 0 else Change.VANISHED, tool)]
        failures = [Failure("ros2", "one that is said each time")]
        reported = Frame(VERSION, "base/ros2", number, now, tallies, samples, events, graph(number), failures)
        session.take([decode_frame(encode_frame(reported)[4:])])
        session.look(now)

    assert_level(turn, ROUNDS // 2)


class Handle:
    def __init__(self, topic):
        self.topic, self.number = topic, 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None

    def get_topic_name(self):
        return self.topic

    def get_logger_name(self):
        return "relay"

    def take_message(self, kind, raw):
        self.number = number = self.number + 1
        info = {"source_timestamp": number, "received_timestamp": number, "publication_sequence_number": number}
        return b"message", {**info, "publisher_gid": {"data": b"\x01" * 16}}

    def publish(self, message):
        return None


class Executor:
    def _take_subscription(self, subscription):
        with subscription.handle:
            return subscription.handle.take_message(subscription.msg_type, subscription.raw)


class Publisher:
    def __init__(self, topic):
        self.handle = Handle(topic)

    def publish(self, msg):
        self.handle.publish(msg)


def test_the_hook(tmp_path, monkeypatch):
    """Publishers come and go, messages do all the time."""
    monkeypatch.setenv(VARIABLE, str(tmp_path / "counters"))
    monkeypatch.setattr(rclpy_hook, "HOOK", rclpy_state.Hook())
    monkeypatch.setattr(rclpy_state, "CounterFile", partial(CounterFile, capacity=16))
    module = SimpleNamespace(Executor=Executor, Publisher=Publisher)
    rclpy_hook.hook_executor(module)
    rclpy_hook.hook_publisher(module)
    subscription = SimpleNamespace(handle=Handle("/in"), msg_type=bytes, raw=True, callback=None)
    lasting, executor = Publisher("/out"), Executor()

    def turn(number, now):
        executor._take_subscription(subscription)
        lasting.publish(b"message")
        if number % 10 == 0:
            Publisher(f"/short{number}").publish(b"message")

    assert_level(turn)
    rclpy_hook.HOOK.close()
