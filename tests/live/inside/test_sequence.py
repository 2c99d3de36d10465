from hypothesis import given
from hypothesis import strategies as st

from roslens.live.inside.sequence import MOST_GAPS, SETTLE_NS, Sequence


def fed(*numbers, at=0):
    sequence = Sequence()
    for number in numbers:
        sequence.feed(number, at)
    return sequence


def test_who_comes_late_has_lost_nothing():
    sequence = fed(1000, 1001, 1002)
    sequence.settle(10 * SETTLE_NS)
    assert (sequence.lost, sequence.pending) == (0, 0)


def test_a_gap_counts_once_it_has_settled():
    sequence = fed(1, 2, 6)
    assert (sequence.lost, sequence.pending) == (0, 3)
    sequence.settle(SETTLE_NS)
    assert sequence.lost == 0
    sequence.settle(SETTLE_NS + 1)
    assert (sequence.lost, sequence.pending) == (3, 0)


def test_what_comes_late_fills_its_gap():
    sequence = fed(1, 6, 4, 2, 5, 3)
    sequence.settle(10 * SETTLE_NS)
    assert (sequence.lost, sequence.pending) == (0, 0)


def test_what_comes_twice_or_from_before_the_beginning_is_nothing():
    sequence = fed(5, 6, 6, 5, 1, 7)
    assert (sequence.lost, sequence.pending) == (0, 0)


def test_gaps_without_end_keep_a_bounded_list():
    sequence = fed(*range(1, 4 * MOST_GAPS, 2))
    assert len(sequence._gaps) <= MOST_GAPS
    sequence.settle(10 * SETTLE_NS)
    assert sequence.lost == len(range(1, 4 * MOST_GAPS, 2)) - 1


@given(st.sets(st.integers(2, 60)), st.randoms())
def test_lost_is_what_never_came_whatever_the_order(missing, random):
    came = [number for number in range(2, 61) if number not in missing]
    random.shuffle(came)
    sequence = fed(1, 61, *came)
    sequence.settle(10 * SETTLE_NS)
    assert sequence.lost == len(missing)
    assert sequence.pending == 0


def test_what_is_missing_in_an_order_that_holds_is_lost_at_once():
    sequence = Sequence(in_order=True)
    for number in (1, 2, 6):
        sequence.feed(number, 0)
    assert (sequence.lost, sequence.pending) == (3, 0)
