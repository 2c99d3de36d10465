import pytest

from roslens.model.transforms.probe import probed
from roslens.model.transforms.transform import Transform

SECOND = 10**9


def stream(parent, child, hertz, begin, end, late=0.0, **more):
    count = round((end - begin) * hertz)
    times = [round((begin + number / hertz) * SECOND) for number in range(count)]
    return [Transform(parent, child, at - round(late * SECOND), received=at, **more) for at in times]


def merged(*streams):
    return sorted((one for each in streams for one in each), key=lambda one: one.received)


def test_a_way_that_is_there_all_the_time_is_one_stretch_with_its_margin():
    found = probed(stream("map", "base", 50, 1, 11, late=0.3), "map", "base", 11 * SECOND)
    (only,) = found.stretches
    assert (only.error, only.since) == ("", pytest.approx(1.1))
    assert found.margin == pytest.approx(0.31, abs=0.02)
    assert found.widest == pytest.approx(0.32, abs=0.1)


def test_a_transform_that_stops_is_the_widest_margin_at_the_end():
    found = probed(
        merged(stream("map", "odom", 10, 1, 5), stream("odom", "base", 50, 1, 9)), "map", "base", 9 * SECOND
    )  # fmt: skip
    assert (found.widest, found.widest_at) == (pytest.approx(4.1, abs=0.15), pytest.approx(9.0, abs=0.1))


def test_what_comes_late_is_not_found_before():
    found = probed(
        merged(stream("map", "odom", 10, 4, 9), stream("odom", "base", 10, 1, 9)), "map", "base", 9 * SECOND
    )  # fmt: skip
    assert [one.error for one in found.stretches] == ["Lookup", ""]
    assert found.stretches[1].since == pytest.approx(4.1, abs=0.15)


def test_clocks_more_than_the_buffer_apart_cannot_be_joined():
    found = probed(
        merged(stream("map", "odom", 10, 1, 9, late=20), stream("odom", "base", 10, 1, 9)), "map", "base", 9 * SECOND
    )  # fmt: skip
    assert found.stretches[-1].error == "Extrapolation"


def test_a_static_way_has_no_margin_and_nothing_has_no_stretch():
    found = probed(stream("a", "b", 1, 1, 2, static=True), "a", "b", 5 * SECOND)
    assert (found.stretches[0].error, found.widest) == ("", 0.0)
    assert probed([], "a", "b", 5 * SECOND).stretches == ()
