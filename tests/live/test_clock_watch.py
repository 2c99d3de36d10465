"""Time runs, stands or jumps."""

from __future__ import annotations

from roslens.live.window.clock_watch import ClockWatch, Course


def courses(times, start=0.0):
    watch = ClockWatch(start)
    return [watch.tick(time) for time in times]


def test_it_stands_when_it_is_the_same_three_times_after_the_first():
    assert courses([1, 1, 1, 1, 2]) == [Course.RUNS] * 3 + [Course.STANDS, Course.RUNS]


def test_it_jumps_back_but_not_by_a_hair():
    assert courses([10, 9.97, 10.1, 3, 3.1]) == [Course.RUNS] * 3 + [Course.JUMPED, Course.RUNS]


def test_it_jumps_forth_only_where_its_step_is_known():
    regular = [number / 10 for number in range(1, 30)]
    assert courses([*regular, 100.0])[-1] is Course.JUMPED
    assert courses([0.1, 100.0])[-1] is Course.RUNS
    assert courses([*regular, 8.0])[-1] is Course.RUNS
