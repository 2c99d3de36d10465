"""Where curves, ticks and marks stand."""

from datetime import datetime
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.charts.line_chart import HEIGHT, MOST_POINTS, WIDTH, LineChart, line_chart
from roslens.model.trend import TrendEvent, TrendPoint


def points(count: int) -> list[TrendPoint]:
    return [TrendPoint(place, f"c{place}", 86_400.0 * place, f"c{place}") for place in range(count)]


def test_a_curve_goes_from_corner_to_corner():
    chart = line_chart(points(3), [("all", [0, 5, 10])], [], 0)
    assert chart is not None
    (line,) = chart.lines
    assert line.paths == (f"M0.0,{HEIGHT} L{WIDTH / 2},{HEIGHT / 2} L{WIDTH},0.0",)
    assert line.places[1][2] == "c1, 1970-01-02: 5"
    assert (line.last, [text for _, text in chart.up]) == ("10", ["0", "5", "10"])
    assert [text for _, text in chart.across] == ["1970-01-01", "1970-01-02", "1970-01-03"]


def stand_apart(chart: LineChart) -> bool:
    """Whether no date stands on another: those at the ends stand inside the plot, others are centred."""
    spans = []
    for x, text in chart.across:
        wide = 8.6 * len(text)
        begin = 0 if not x else WIDTH - wide if x == WIDTH else x - wide / 2
        spans.append((begin, begin + wide))
    return all(one[1] <= other[0] for one, other in pairwise(spans))


@pytest.mark.parametrize("count", [2, 3, 7, 8, 15, 16, 400])
def test_dates_do_not_stand_on_one_another(count):
    chart = line_chart(points(count), [("all", list(range(count)))], [], 0)
    assert chart is not None
    assert (chart.across[0][0], chart.across[-1][0]) == (0, WIDTH)
    assert stand_apart(chart)
    assert len(chart.across) >= min(count, 5)


@pytest.mark.parametrize(
    ("most", "texts"),
    [
        (5_000, ["0", "2,000", "4,000", "6,000"]),
        (87_000, ["0", "50 k", "100 k"]),
        (900_000, ["0", "500 k", "1,000 k"]),
        (2_000_000, ["0", "0.5 M", "1.0 M", "1.5 M", "2.0 M"]),
        (30_000_000, ["0", "10 M", "20 M", "30 M"]),
    ],
)
def test_amounts_are_as_short_as_their_room_is_narrow(most, texts):
    chart = line_chart(points(2), [("all", [0, most])], [], 0)
    assert chart is not None
    assert [text for _, text in chart.up] == texts


def test_a_gap_is_a_gap():
    chart = line_chart(points(5), [("all", [1, 2, None, 3, 4]), ("none", [None] * 5)], [], 0)
    assert chart is not None
    assert [len(line.paths) for line in chart.lines] == [2]


def test_nothing_to_draw():
    assert line_chart(points(2), [("none", [None, None])], [], 0) is None
    assert line_chart([], [], [], 0) is None


def test_amounts_begin_at_nought_unless_they_are_far_from_it():
    near = line_chart(points(2), [("a", [10, 100])], [], 0)
    far = line_chart(points(2), [("a", [7000, 7100])], [], 0)
    assert near is not None
    assert far is not None
    assert (near.up[0][1], far.up[0][1]) == ("0", "7,000")


def test_what_is_counted_has_no_ticks_between_two_numbers():
    few = line_chart(points(3), [("findings", [0, 1, 2])], [], 0)
    ratio = line_chart(points(3), [("ratio", [0, 0.5, 2])], [], 2)
    assert few is not None
    assert ratio is not None
    assert [text for _, text in few.up] == ["0", "1", "2"]
    assert "0.5" in [text for _, text in ratio.up]


def test_what_never_changes_has_a_line():
    for value in (0.0, 7.0, -3.0):
        chart = line_chart(points(2), [("a", [value, value])], [], 0)
        assert chart is not None
        assert all(0 <= y <= HEIGHT for _, y, _ in chart.lines[0].places)
    single = line_chart(points(1), [("a", [7.0])], [], 0)
    assert single is not None
    assert single.lines[0].places[0][0] == WIDTH / 2


def test_many_points_are_thinned_and_events_kept():
    many = 3 * MOST_POINTS
    chart = line_chart(points(many), [("a", list(range(many)))], [TrendEvent(100, "release", "1.0")], 0)
    assert chart is not None
    places = chart.lines[0].places
    assert len(places) <= MOST_POINTS + 1
    assert (places[0][0], places[-1][0]) == (0.0, WIDTH)
    assert chart.marks[0].x in [x for x, _, _ in places]


def test_texts_of_marks_do_not_stand_on_each_other():
    events = [TrendEvent(place, "release", f"1.{place}.0") for place in range(40)]
    chart = line_chart(points(40), [("a", [1.0] * 40)], events, 0)
    assert chart is not None
    shown = [mark for mark in chart.marks if mark.labelled]
    assert 5 < len(shown) < 40
    begins = [mark.x - 40 if mark.left else mark.x for mark in shown]
    assert all(second - first >= 40 for first, second in pairwise(begins))
    assert chart.dense


def at(*dates: str) -> list[TrendPoint]:
    times = [datetime.fromisoformat(f"{one}T12:00:00+00:00").timestamp() for one in dates]
    return [TrendPoint(place, f"c{place}", time, f"v{place}") for place, time in enumerate(times)]


def test_revisions_stand_where_their_time_is():
    dates = at("2014-01-01", "2020-01-01", "2022-01-01", "2024-01-01")
    chart = line_chart(dates, [("all", [1, 2, 3, 4])], [TrendEvent(1, "release", "1.0")], 0)
    assert chart is not None
    years = [0, 6, 8, 10]
    assert chart.places == pytest.approx([WIDTH * one / 10 for one in years], abs=0.5)
    assert [x for x, _, _ in chart.lines[0].places] == list(chart.places)
    assert chart.marks[0].x == chart.places[1]
    assert [text for _, text in chart.across] == ["2014-01-01", "2016", "2018", "2020", "2022", "2024-01-01"]
    # A year begins half a day before noon of its first day.
    assert {text: x for x, text in chart.across}["2020"] == pytest.approx(chart.places[1], abs=0.5)


def test_a_wrong_clock_moves_no_revision_before_the_one_that_it_follows():
    chart = line_chart(at("2020-01-01", "2021-01-01", "2001-01-01", "2022-01-01"), [("all", [1, 2, 3, 4])], [], 0)
    assert chart is not None
    assert list(chart.places) == sorted(chart.places)
    assert chart.places[1] == chart.places[2]


def test_revisions_of_one_instant_stand_at_equal_distances():
    chart = line_chart(at(*["2020-01-01"] * 3), [("all", [1, 2, 3])], [], 0)
    assert chart is not None
    assert chart.places == (0.0, WIDTH / 2, WIDTH)


@pytest.mark.parametrize(
    ("first", "last", "texts"),
    [
        ("2021-03-04", "2021-03-10", ["2021-03-06", "2021-03-07", "2021-03-08", "2021-03-09"]),
        ("2021-01-15", "2021-06-20", ["2021-03", "2021-04", "2021-05"]),
        ("2018-11-05", "2020-12-05", ["2019-04", "2019-07", "2019-10", "2020-01", "2020-04", "2020-07"]),
        ("2009-02-01", "2026-02-01", ["2012", "2014", "2016", "2018", "2020", "2022"]),
    ],
)
def test_dates_between_are_round(first, last, texts):
    chart = line_chart(at(first, last), [("all", [1, 2])], [], 0)
    assert chart is not None
    assert [text for _, text in chart.across[1:-1]] == texts


@given(st.lists(st.floats(0, 4e9), min_size=2, max_size=40))
def test_no_date_stands_on_another(times):
    chart = line_chart(
        [TrendPoint(n, f"c{n}", t, f"c{n}") for n, t in enumerate(times)], [("a", [1.0] * len(times))], [], 0
    )
    assert chart is not None
    assert stand_apart(chart)
