import numpy as np

from roslens.live.adapters.bag.steps import LATEST, LONGEST_QUIET, Lane, Steps

LANE = Lane("/a", "")
OTHER = Lane("/b", "")


def ints(*values):
    return np.array(values, np.int64)


def add(steps, *times, lane=LANE):
    steps.add(lane, ints(*times), ints(*[10] * len(times)), None)


def counts(found):
    return [[tally.count for tally in tallies] for _, tallies in found]


def test_a_step_is_told_once_nothing_earlier_will_come():
    steps = Steps(0, 100, [LANE, OTHER])
    add(steps, 0, 99, 100, 350)
    assert list(steps.until(99)) == []
    assert counts(steps.until(100)) == [[2, 0]]
    assert steps.pending == 2
    assert counts(steps.until(399)) == [[1, 0], [0, 0]]
    assert counts(steps.rest(350)) == [[1, 0]]
    assert (steps.counted, steps.late, steps.pending) == (4, 0, 0)


def test_a_gap_belongs_to_the_step_in_which_it_ended():
    steps = Steps(0, 10**9, [LANE])
    add(steps, 0, 900_000_000, 1_100_000_000)
    first, second = (tallies[0] for _, tallies in steps.rest(0))
    assert (first.period.count, first.period.total) == (1, 0.9)
    assert (second.period.count, round(second.period.least, 9)) == (1, 0.2)
    add(steps, 5_100_000_000)
    last = list(steps.rest(0))[-1][1][0]
    assert (last.period.count, last.period.greatest) == (1, 4.0)


def test_late_and_impossible_times_are_counted_apart():
    steps = Steps(1000, 100, [LANE])
    add(steps, 1000, 1150)
    assert counts(steps.until(1200)) == [[1], [1]]
    add(steps, 1199, 1200, -5, LATEST + 5)
    assert counts(steps.until(1300)) == [[1]]
    assert (steps.late, steps.counted) == (3, 3)


def test_a_long_silence_is_shortened():
    steps = Steps(0, 1, [LANE])
    add(steps, 0, 10**15)
    assert len(list(steps.rest(0))) == 2 + LONGEST_QUIET
    assert steps.jumps == [(1 + LONGEST_QUIET, 10**15)]


def test_when_the_longest_gap_of_a_step_began():
    steps = Steps(0, 10**9, [LANE])
    add(steps, 0, 100_000_000, 600_000_000, 900_000_000, 1_700_000_000, 1_800_000_000)
    first, second = (tallies[0] for _, tallies in steps.rest(0))
    assert (first.longest_at, second.longest_at) == (0.1, 0.9)
