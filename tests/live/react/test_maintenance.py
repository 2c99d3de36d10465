import time

import pytest

from roslens.live.react.maintenance import parse_window, window_now


def at(day, hour, minute=0):
    return time.mktime((2026, 3, 2 + day, hour, minute, 0, 0, 0, -1))  # day 0 is a Monday


@pytest.mark.parametrize(
    ("text", "within", "outside"),
    [
        ("22:00-23:30", [at(0, 22), at(6, 23, 29)], [at(0, 21, 59), at(0, 23, 30)]),
        ("Sat 08:00-12:00", [at(5, 8)], [at(4, 8), at(6, 8), at(5, 12)]),
        ("Mon-Fri 22:00-02:00", [at(0, 22), at(4, 23), at(5, 1, 59)], [at(5, 22), at(0, 1), at(5, 2)]),
        ("Sat-Mon 00:00-24:00", [at(5, 0), at(6, 23, 59), at(0, 12)], [at(1, 0), at(4, 23, 59)]),
    ],
)
def test_a_window_holds_its_times(text, within, outside):
    windows = (parse_window(text),)
    assert all(window_now(windows, one) for one in within)
    assert not any(window_now(windows, one) for one in outside)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("tonight", "expected `22:00"),
        ("25:00-26:00", "00:00 to 24:00"),
        ("Foo 01:00-02:00", "'foo'"),
        ("01:00-01:00", "is empty"),
        ("24:30-25:00", "00:00 to 24:00"),
        ("01:60-02:00", "00:00 to 24:00"),
    ],
)
def test_what_is_no_window_is_refused(text, why):
    with pytest.raises(ValueError, match="expected") as caught:
        parse_window(text)
    assert why in str(caught.value)
