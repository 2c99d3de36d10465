import random

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.graph import Change, Event, Graph, Node
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Moments, Observer, Tally
from roslens.model.wire import VERSION, Frame, FrameReader, WireError, decode_frame, encode_frame

FRAME = Frame(
    VERSION,
    "base/ros2",
    7,
    1700000000.5,
    [Tally("/scan", "/lidar", "/nav", 1.0, 2.0, 10, 400, 1.05, 1.95, Moments(10, 1.0, 0.1, 0.09, 0.11), lost=0)],
    [Sample(EntityId(EntityKind.HOST, "base"), 2.0, {"cpu": 12.5}, Observer.AGENT)],
    [Event(1.5, Change.APPEARED, "node:/nav")],
    Graph("ros2", (Node("/nav", "base", 12, ("gid",)),)),
    [Failure("agent", "no sensor")],
    3,
)


def test_what_is_sent_arrives():
    (frame,) = FrameReader().feed(encode_frame(FRAME))
    assert frame == FRAME


@given(st.lists(st.integers(1, 40), max_size=20))
def test_pieces_of_any_size(cuts):
    stream = encode_frame(FRAME) * 3
    reader, found, at = FrameReader(), [], 0
    for cut in [*cuts, len(stream)]:
        found += reader.feed(stream[at : at + cut])
        at += cut
    assert found == [FRAME] * 3


def test_a_frame_of_another_version_says_so():
    body = encode_frame(msgspec.structs.replace(FRAME, version=9))[4:]
    with pytest.raises(WireError, match="version 9, expected 2"):
        decode_frame(body)
    with pytest.raises(WireError, match="version 3, expected 2"):
        decode_frame(msgspec.msgpack.encode([3, {"another": "shape"}]))


def test_a_frame_that_is_too_long_is_refused_before_it_is_read():
    with pytest.raises(WireError, match="4,294,967,295 bytes, expected at most 16,000,000"):
        list(FrameReader().feed(b"\xff\xff\xff\xff"))


@pytest.mark.parametrize("field", ["time", "looked"])
def test_a_time_that_is_no_number(field):
    with pytest.raises(WireError, match=f"whose {field} is nan"):
        decode_frame(encode_frame(msgspec.structs.replace(FRAME, **{field: float("nan")}))[4:])


def test_up_to_when_was_looked_is_told_or_follows_from_traffic():
    looked = decode_frame(encode_frame(msgspec.structs.replace(FRAME, looked=7.5))[4:])
    assert (looked.looked, looked.vouched) == (7.5, 7.5)
    assert FRAME.vouched == (FRAME.time if FRAME.tallies else 0.0)
    assert msgspec.structs.replace(FRAME, tallies=[]).vouched == 0.0


@settings(max_examples=500)
@given(st.binary(max_size=200))
def test_garbage_is_named(body):
    said = ""
    try:
        said = str(decode_frame(body).version)
    except WireError as error:
        said = str(error)
    assert said


def test_mutated_frames_are_frames_or_named():
    rng = random.Random(1)
    good = encode_frame(FRAME)[4:]
    refused = 0
    for _ in range(5_000):
        body = bytearray(good)
        for _ in range(rng.randint(1, 4)):
            body[rng.randrange(len(body))] = rng.randrange(256)
        try:
            decode_frame(bytes(body))
        except WireError:
            refused += 1
    assert refused > 1_000
