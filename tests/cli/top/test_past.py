from hypothesis import given
from hypothesis import strategies as st

from roslens.cli.top.past import BARS, Past, sparkline
from roslens.dashboard.live.snapshot import Picture, Row, Snapshot


def snapshot(time, **values):
    rows = tuple(
        Row(entity, entity, entity, "topic", 0, "ok", values={"rate": value}) for entity, value in values.items()
    )
    return Snapshot(2, time, "12:00", "rover", True, "ok", {}, "1 %", (), rows, (), Picture(), (), ())


def test_values_are_kept_with_gaps_where_there_were_none():
    past = Past(3)
    past.take(snapshot(1.0, scan=10.0))
    past.take(snapshot(2.0))
    past.take(snapshot(2.0, scan=99.0))
    past.take(snapshot(3.0, scan=12.0, odom=5.0))
    assert past.series("scan", "rate") == (10.0, None, 12.0)
    assert past.series("odom", "rate") == (None, None, 5.0)
    past.take(snapshot(4.0, odom=5.0))
    assert past.series("scan", "rate") == (None, 12.0, None)


def test_what_is_gone_for_long_is_forgotten():
    past = Past(2)
    for time, values in enumerate(({"scan": 1.0}, {}, {})):
        past.take(snapshot(float(time), **values))
    assert past.series("scan", "rate") == ()


def test_bars_go_from_the_least_to_the_greatest():
    assert sparkline([0.0, None, 7.0, 3.5], 10) == "▁ █▅"
    assert sparkline([1.0, 2.0, 3.0], 2) == "▁█"
    assert sparkline([4.0, 4.0], 10) == "▄▄"
    assert sparkline([None], 10) == ""


@given(st.lists(st.one_of(st.none(), st.floats(-1e9, 1e9)), max_size=50), st.integers(1, 60))
def test_a_sparkline_never_is_wider_and_has_a_bar_for_each_value(values, width):
    line = sparkline(values, width)
    assert len(line) <= width
    assert sum(sign in BARS for sign in line) == sum(value is not None for value in values[-width:])
