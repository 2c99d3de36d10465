from hypothesis import given
from hypothesis import strategies as st

from roslens.live.join.one_stretch import OneStretch
from roslens.model.traffic.tally import Tally


def tally(start, end, count=1, publisher="/a"):
    return Tally("/x", publisher, "/b", start, end, count, last=end if count else 0.0, first=end if count else 0.0)


def spans(tallies):
    return [(one.start, one.end, one.count) for one in tallies]


def test_what_a_node_counts_by_two_identifiers_is_one():
    assert spans(OneStretch().of([tally(0.0, 1.0, 3), tally(0.0, 1.0, 4), tally(0.0, 1.0, 1, "/c")])) == [
        (0.0, 1.0, 7), (0.0, 1.0, 1),
    ]  # fmt: skip


def test_silence_of_one_is_no_silence_of_the_other():
    one = OneStretch()
    for step in range(5):
        assert spans(one.of([tally(step, step + 1.0, 4)])) == [(step, step + 1.0, 4)]
    assert one.of([tally(0.0, 5.0, 0)]) == []
    assert spans(one.of([tally(5.0, 6.0, 4), tally(0.0, 6.0, 0)])) == [(5.0, 6.0, 4)]


def test_a_clock_that_was_set_back_begins_anew():
    one = OneStretch()
    one.of([tally(999.0, 1000.0)])
    assert spans(one.of([tally(1.0, 2.0)])) == [(1.0, 2.0, 1)]


@given(st.lists(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 3)), max_size=3), max_size=9))
def test_no_message_is_left_out_and_no_time_told_twice(reads):
    one, until, counted = OneStretch(), 0.0, 0
    for number, read in enumerate(reads):
        end = number + 1.0
        for reported in one.of(tally(max(end - 1 - back, 0.0), end, count) for back, count in read):
            assert until <= reported.start <= reported.end
            until = reported.end
            counted += reported.count
    assert counted == sum(count for read in reads for _, count in read)
