import contextlib
import math

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.acting.outgoing import (
    MAX_BYTES,
    VERSION,
    ConnectionStatistics,
    Outgoing,
    OutgoingError,
    OutgoingReader,
    RatedSignal,
    RatedSignals,
    Status,
    encode_outgoing,
)

TEXT = st.text(max_size=20)
NUMBER = st.floats(allow_nan=False)
STATUS = st.builds(Status, st.integers(0, 3), TEXT, TEXT, TEXT, st.lists(st.tuples(TEXT, TEXT), max_size=3).map(tuple))
SIGNAL = st.builds(
    RatedSignal, TEXT, TEXT, TEXT, TEXT, TEXT, NUMBER, NUMBER, NUMBER, st.integers(0, 5), NUMBER, st.integers(0, 2),
    TEXT, TEXT, TEXT,
)  # fmt: skip
TRAFFIC = st.builds(ConnectionStatistics, TEXT, TEXT, TEXT, *[NUMBER] * 9)
RATED = st.builds(
    RatedSignals, TEXT, st.booleans(), st.integers(0, 9), st.integers(0, 9), st.lists(SIGNAL, max_size=2).map(tuple),
    st.lists(TRAFFIC, max_size=2).map(tuple),
)  # fmt: skip
FRAME = st.builds(
    Outgoing, st.just(VERSION), NUMBER, st.none() | st.lists(STATUS, max_size=3).map(tuple), st.none() | RATED
)


@given(st.lists(FRAME, max_size=4), st.integers(1, 50))
def test_what_is_written_is_read_in_pieces_of_any_size(frames, size):
    stream = b"".join(map(encode_outgoing, frames))
    reader = OutgoingReader()
    found = [frame for start in range(0, len(stream), size) for frame in reader.feed(stream[start : start + size])]
    assert found == frames


def test_what_is_not_known_goes_over_the_line_as_nan():
    frame = Outgoing(VERSION, 1.0, rated=RatedSignals("m", True, 0, 1, (), (ConnectionStatistics("/t", "/a", "/b"),)))
    (read,) = OutgoingReader().feed(encode_outgoing(frame))
    assert math.isnan(read.rated.connections[0].rate)


@given(st.binary(max_size=200))
def test_garbage_is_an_error_or_nothing_yet_and_never_anything_else(garbage):
    found = []
    with contextlib.suppress(OutgoingError):
        found.extend(OutgoingReader().feed(garbage))
    assert all(isinstance(one, Outgoing) for one in found)


def framed(value):
    body = msgspec.msgpack.encode(value)
    return len(body).to_bytes(4, "big") + body


def test_another_version_and_a_length_that_is_none_are_refused():
    with pytest.raises(OutgoingError, match="version 2, expected 1"):
        list(OutgoingReader().feed(framed([2, 1.0])))
    with pytest.raises(OutgoingError, match="at most"):
        list(OutgoingReader().feed(b"\xff\xff\xff\xff"))


def test_what_no_reader_takes_is_not_written():
    with pytest.raises(OutgoingError, match="expected at most"):
        encode_outgoing(Outgoing(VERSION, 1.0, (Status(0, "x" * MAX_BYTES, "", "", ()),)))
