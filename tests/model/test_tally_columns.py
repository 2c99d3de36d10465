import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally
from roslens.model.traffic.tally_columns import Columns, TallyColumns, columns_of, fits, names_of, row_of, tally_of
from roslens.model.wire import VERSION, Frame, WireError, decode_frame, encode_frame

NAME = st.text(st.characters(exclude_characters="\n", exclude_categories=["Cs"]), max_size=5)
NUMBER = st.floats(allow_nan=False)
SERIES = st.just(NOTHING) | st.builds(Moments, st.integers(0, 9), NUMBER, NUMBER, NUMBER, NUMBER)
TALLY = st.builds(
    Tally, NAME, NAME, NAME, NUMBER, NUMBER, st.integers(-1, 9), st.integers(-1, 9), NUMBER, NUMBER, SERIES, SERIES,
    SERIES, st.integers(-1, 9), st.sampled_from(Observer), NAME, SERIES, NUMBER,
)  # fmt: skip
SAME = Tally("/a", "/p", "/s", 1.0, 2.0, 3)


@given(st.lists(TALLY, max_size=6))
def test_what_is_told_by_columns_is_read(tallies):
    frame = decode_frame(encode_frame(Frame(VERSION, "h/x", 0, 1.0, tallies))[4:])
    assert frame.tallies == tallies
    assert [*frame.tallies] == tallies
    assert len(frame.tallies) == len(tallies)
    if tallies:
        assert (frame.tallies[-1], frame.tallies[:1]) == (tallies[-1], tallies[:1])
        assert [tally_of(*one) for one in zip(frame.tallies.names, frame.tallies.rows(), strict=True)] == tallies


@given(TALLY)
def test_a_row_is_a_tally_without_its_names(tally):
    assert tally_of(f"{tally.topic}\n{tally.publisher}\n{tally.subscriber}", row_of(tally)) == tally


def test_what_all_tallies_say_goes_once():
    many = [msgspec.structs.replace(SAME, topic=f"/{number}", bytes=number) for number in range(50)]
    columns = columns_of(many)
    assert (columns.start, columns.bytes) == ([1.0], list(range(50)))


def test_a_name_with_a_line_break_arrives_too():
    odd = msgspec.structs.replace(SAME, publisher="/p\n/q")
    assert not fits(odd)
    assert list(decode_frame(encode_frame(Frame(VERSION, "agent", 0, 1.0, [odd, SAME]))[4:]).tallies) == [SAME, odd]
    assert list(decode_frame(encode_frame(Frame(VERSION, "agent", 0, 1.0, [odd]))[4:]).tallies) == [odd]


@pytest.mark.parametrize(
    ("text", "names"), [("", ("", "", "")), ("/a", ("/a", "", "")), ("a\nb\nc\nd", ("a", "b", "c\nd"))]
)
def test_names_that_are_missing_are_empty(text, names):
    assert names_of(text) == names


@pytest.mark.parametrize(("names", "values"), [(3, 2), (0, 1), (2, 0), (1, 2)])
def test_columns_of_different_lengths_are_no_frame(names, values):
    columns = msgspec.structs.replace(columns_of([SAME] * names), start=[1.0] * values)
    assert isinstance(columns, Columns)
    what = f"{values} values of start for {names} tallies"
    with pytest.raises(ValueError, match=what):
        TallyColumns(columns)
    packed = msgspec.msgpack.encode([VERSION, "h/x", 0, 1.0, [], [], [], None, [], 0, "", columns])
    with pytest.raises(WireError, match=f"not a frame: {what}"):
        decode_frame(packed)
