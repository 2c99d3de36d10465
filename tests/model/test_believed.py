"""What an authenticated peer may send: what cannot be true is left out and named, the rest is taken."""

import pytest

from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Endpoint, Event, Graph, Node, Process, Role
from roslens.model.qos import Qos
from roslens.model.traffic.sample import Sample
from roslens.model.wire import VERSION, Frame, WireError, decode_frame, encode_frame

HOST = EntityId(EntityKind.HOST, "base")
GOOD_EVENT = Event(1.0, Change.APPEARED, "node:/nav")
GOOD_SAMPLE = Sample(HOST, 1.0, {"cpu": 1.0})
NODE, PROCESS = Node("/nav", "base", 12), Process("base", 12, "nav")
END = Endpoint("/nav", Role.PUBLISHER, "/scan", "s/msg/S", qos=Qos(depth=10))


def sent(**parts):
    return decode_frame(encode_frame(Frame(VERSION, "base/agent", 1, 5.0, **parts))[4:])


@pytest.mark.parametrize(
    ("event", "said"),
    [
        (Event(1.0, Change.VANISHED, "process:"), "an event with the entity 'process:'"),
        (Event(1.0, Change.VANISHED, "nothing:/nav"), "an event with the entity 'nothing:/nav'"),
        (Event(1.0, Change.VANISHED, "process:/a"), "an event with the process '/a'"),
        (Event(1.0, Change.VANISHED, ""), "an event with the entity ''"),
        (Event(float("nan"), Change.VANISHED, "node:/nav"), "an event with the time nan"),
        (Event(1.0, Change.CHANGED, "node:/nav", "x" * 70_000), "an event with a text of 70,000 characters"),
    ],
)
def test_an_event_of_nothing(event, said):
    frame = sent(events=[GOOD_EVENT, event], samples=[GOOD_SAMPLE])
    assert (frame.events, frame.samples) == ([GOOD_EVENT], [GOOD_SAMPLE])
    (failure,) = frame.failures
    assert failure.what == f"'base/agent' sent {said}"
    assert failure.partial


@pytest.mark.parametrize(
    "sample",
    [
        Sample(EntityId(EntityKind.NODE, ""), 1.0, {"cpu": 1.0}),
        Sample(HOST, float("inf"), {"cpu": 1.0}),
        Sample(HOST, 1.0, {"x" * 70_000: 1.0}),
    ],
)
def test_a_sample_of_nothing(sample):
    frame = sent(samples=[sample, GOOD_SAMPLE])
    assert frame.samples == [GOOD_SAMPLE]
    assert len(frame.failures) == 1


@pytest.mark.parametrize(
    "part",
    [
        {"nodes": (Node(""), NODE)},
        {"nodes": (Node("/x", pid=-1), NODE)},
        {"nodes": (NODE, Node("/x", pid=1 << 40))},
        {"processes": (PROCESS, Process("base", -3))},
        {"processes": (PROCESS, Process("base", 3, started=float("nan")))},
        {"processes": (PROCESS, Process("base", 3, inner=1 << 40))},
        {"endpoints": (END, Endpoint("/nav", Role.PUBLISHER, ""))},
        {"endpoints": (END, Endpoint("", Role.PUBLISHER, "/scan"))},
        {"endpoints": (END, Endpoint("/nav", Role.PUBLISHER, "/scan", qos=Qos(depth=-1)))},
        {"endpoints": (END, Endpoint("/nav", Role.PUBLISHER, "/scan", qos=Qos(deadline_s=float("nan"))))},
        {"endpoints": (END, Endpoint("/nav", Role.PUBLISHER, "/scan", gid="010fxyz"))},
        {"hosts": ("base", "")},
        {"identities": {"base": ("z",)}},
    ],
)
def test_a_graph_of_what_cannot_be(part):
    good = {"nodes": (NODE,), "processes": (PROCESS,), "endpoints": (END,), "hosts": ("base",)}
    frame = sent(graph=Graph("ros2", **{**good, **part}))
    assert frame.graph == Graph("ros2", **good)
    assert len(frame.failures) == 1


def test_what_is_right_is_taken_as_it_is():
    graph = Graph("ros2", (NODE,), (END,), ("base",), (PROCESS,))
    frame = sent(events=[GOOD_EVENT], samples=[GOOD_SAMPLE], graph=graph)
    assert (frame.events, frame.samples, frame.graph, frame.failures) == ([GOOD_EVENT], [GOOD_SAMPLE], graph, [])


def test_many_wrong_records_are_one_failure():
    frame = sent(events=[Event(1.0, Change.VANISHED, "process:")] * 1000)
    assert (frame.events, len(frame.failures)) == ([], 1)


@pytest.mark.parametrize(
    "frame",
    [
        Frame(VERSION, "", 1, 5.0),
        Frame(VERSION, "x" * 70_000, 1, 5.0),
        Frame(VERSION, "base/agent", -1, 5.0),
        Frame(VERSION, "base/agent", 1, 5.0, shed=-1),
        Frame(VERSION, "base/agent", 1, 5.0, shed=(1 << 64) - 1),
    ],
)
def test_a_frame_from_nobody(frame):
    with pytest.raises(WireError, match="expected"):
        decode_frame(encode_frame(frame)[4:])
