"""What a window makes of silence, of what comes late, twice or from another time; worked out by hand."""

import itertools

import pytest

from roslens.live.window.observer_rank import RANK
from roslens.live.window.window import Window
from roslens.model.traffic.tally import Moments, Observer, Tally

SECOND = Moments(1, 0.5, 0.25, 0.5, 0.5)


def tally(start, end, count=1, *, first=0.0, last=0.0, **more):
    return Tally("/a", "/p", "/s", start, end, count, more.pop("bytes", -1), first, last, **more)


def window(*tallies, length=10.0, most=20, now=0.0):
    made = Window(Observer.INSIDE, "", length, most)
    for one in tallies:
        made.add(one, now)
    return made


def steady(many=5, **more):
    """Tallies of a second each from 100 on, a message in the middle of each."""
    seconds = range(100, 100 + many)
    tallies = [tally(at, at + 1.0, first=at + 0.5, last=at + 0.5, period=SECOND) for at in map(float, seconds)]
    made = window(*tallies, **more)
    made.settle(0.0)
    return made


def spans(made):
    return [(bucket.start, bucket.end, bucket.count) for bucket in made.buckets]


def test_patience_is_one_and_a_half_tallies_and_a_bit():
    made = steady()
    assert made.spacing == 1.0
    assert made.patience == pytest.approx(1.55)
    made.settle(1.54)
    assert (made.horizon, made.quiet) == (105.0, 0.5)
    made.settle(1.56)
    assert made.horizon == pytest.approx(106.56)
    assert made.quiet == pytest.approx(2.06)


def test_nothing_for_twice_the_usual_time_is_silence():
    made = steady()
    assert made.intervals == 5
    assert made.span == pytest.approx(2.5)
    made.settle(0.0)
    assert not made.silent
    made.quiet = 1.0  # 5 intervals of 0.5 s: silent after 1 s
    assert not made.silent
    made.quiet = 1.001
    assert made.silent


def test_who_never_heard_is_silent_once_it_is_watched():
    made = Window(Observer.INSIDE, "")
    assert not made.silent
    made.add(tally(100.0, 101.0, 0), 0.0)
    made.settle(0.0)
    assert made.silent
    assert made.quiet == 1.0


def test_what_is_older_than_the_window_goes_with_silence():
    made = steady(length=3.0)
    made.settle(0.0)
    assert spans(made)[0][0] >= 102.0 - 1e-6
    assert made.count == 3
    made.settle(20.0)
    assert made.count == 0
    assert made.filled


def test_what_comes_late_is_put_where_nothing_is_known():
    made = window(tally(100.0, 101.0, 1, last=100.5), tally(103.0, 104.0, 1, last=103.5))
    assert made.add(tally(101.0, 102.0, 7), 0.0)
    assert spans(made) == [(100.0, 101.0, 1), (101.0, 102.0, 7), (103.0, 104.0, 1)]
    made.settle(0.0)
    assert made.count == 9
    assert made.until == 104.0


@pytest.mark.parametrize(
    ("late", "why"),
    [
        (tally(100.2, 100.8, 7), "inside of what is known"),
        (tally(100.5, 101.5, 7), "it reaches into what is known before"),
        (tally(102.5, 103.5, 7), "it reaches into what is known after"),
        (tally(101.0, 102.0, 0), "it tells nothing"),
        (tally(99.0, 100.0, 7), "before the beginning"),
        (tally(103.0, 104.0, 7), "twice"),
    ],
)
def test_what_is_known_already_is_not_taken_again(late, why):
    made = window(tally(100.0, 101.0, 1, last=100.5), tally(103.0, 104.0, 1, last=103.5))
    assert made.add(late, 0.0) is False, why
    assert spans(made) == [(100.0, 101.0, 1), (103.0, 104.0, 1)]


def test_what_is_late_by_more_than_the_window_is_not_taken():
    made = window(*(tally(float(at), at + 0.9, 1, last=at + 0.5) for at in range(100, 120)), length=5.0)
    before = spans(made)
    assert made.add(tally(110.9, 111.0, 7), 0.0) is False
    assert made.add(tally(117.9, 118.0, 7), 0.0) is True
    assert sum(count for *_, count in spans(made)) == sum(count for *_, count in before) + 7


def test_of_what_reaches_back_the_new_part_is_taken():
    made = window(tally(100.0, 101.0, 4, first=100.1, last=100.9))
    assert made.add(tally(100.5, 102.5, 8, first=100.6, last=102.4, bytes=800, lost=4), 0.0)
    assert spans(made)[-1][1:] == (102.5, spans(made)[-1][2])
    made.settle(0.0)
    # Three quarters of it are new.
    assert made.count == 4 + 6
    assert made.bytes == 600
    assert sum(bucket.lost for bucket in made.buckets) == 3
    assert made.last == 102.4


def test_all_of_what_reaches_back_is_new_where_its_messages_are():
    made = window(tally(100.0, 101.0, 4, first=100.1, last=100.9))
    made.add(tally(100.5, 102.5, 8, first=101.0, last=102.4, bytes=800, period=SECOND), 0.0)
    made.settle(0.0)
    assert (made.count, made.bytes) == (12, 800)


def test_buckets_are_merged_in_pairs_and_nothing_is_lost():
    made = window(length=1000.0, most=4)
    total = 0
    for number in range(40):
        start = 100.0 + 300 * number
        made.add(tally(start, start + 300.0, number, last=start + 299.0), 0.0)
        made.length = 1e6
        total += number
        assert len(made.buckets) <= 4
    made.settle(0.0)
    assert made.count == total
    ends = spans(made)
    assert ends[0][0] == 100.0
    assert all(one[1] <= other[0] + 1e-6 for one, other in itertools.pairwise(ends))


def stepped(made, start, many, now):
    return [
        made.add(tally(start + number, start + number + 1.0, 1, last=start + number + 0.5), now)
        for number in range(many)
    ]


def test_a_clock_that_stepped_is_believed_after_three_tallies_and_patience():
    made = steady()
    assert stepped(made, 10_000.0, 2, 5.0) == [False, False]
    assert spans(made)[-1][1] == 105.0
    assert stepped(made, 10_002.0, 1, 5.0) == [True]
    assert made.stepped
    assert made.begun == 10_000.0
    assert made.until == 10_003.0
    made.settle(5.0)
    assert made.count == 3
    assert made.spacing == pytest.approx(1.0)


def test_a_clock_is_not_taken_for_stepped_while_the_old_one_goes_on():
    made = steady()
    assert stepped(made, 10_000.0, 5, 1.0) == [False] * 5
    assert not made.stepped
    back = steady()
    assert stepped(back, 50.0, 4, 5.0)[:3] == [False, False, True]
    assert back.begun == 50.0


def test_strange_tallies_that_do_not_follow_each_other_are_mistakes():
    made = steady()
    for start in (10_000.0, 9_000.0, 10_000.0, 9_000.0):
        assert made.add(tally(start, start + 1.0), 5.0) is False
    assert not made.stepped


def test_who_counts_itself_is_better_than_who_looks_from_outside():
    order = [Observer.INSIDE, Observer.SCRIPTED, Observer.TAP, Observer.PROTOCOL, Observer.RECORDING, Observer.AGENT]
    assert sorted(RANK, key=RANK.get) == order
    assert [RANK[one] for one in order] == list(range(6))


def test_what_is_told_twice_is_no_stepped_clock():
    made = steady()
    assert stepped(made, 101.0, 3, 5.0) == [False] * 3
    assert not made.stepped
    assert made.begun == 100.0
    assert made.count == 5


def test_neighbours_share_a_bucket_up_to_one_and_a_half_shares_of_the_window():
    made = window(*(tally(100 + at / 4, 100 + (at + 1) / 4) for at in range(12)), length=10.0, most=20)
    assert spans(made) == [(100 + at * 0.75, 100 + (at + 1) * 0.75, 3) for at in range(4)]


def test_an_even_number_of_buckets_is_halved():
    made = Window(Observer.INSIDE, "", 60.0, 5)
    for at in range(6):
        made.add(tally(100.0 + 30 * at, 130.0 + 30 * at, at + 1), 0.0)
        made.length = 1000.0
    assert spans(made) == [(100.0, 160.0, 3), (160.0, 220.0, 7), (220.0, 280.0, 11)]


def test_a_brief_window_keeps_what_reaches_into_it_as_a_whole():
    made = window(*(tally(100 + at / 5, 100 + (at + 1) / 5) for at in range(5)), length=0.5)
    made.settle(0.0)
    assert spans(made)[0][:2] == pytest.approx((100.4, 100.6))
    assert made.count == 3


def test_a_part_without_its_last_message_ends_with_the_tally():
    made = window(tally(100.0, 101.0, 4, first=100.1, last=100.9))
    made.add(tally(100.5, 102.5, 8, first=100.6, last=100.95), 0.0)
    assert made.last == 102.5
