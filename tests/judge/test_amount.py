"""Amounts and ranges of them: units, forms, exact numbers, and what is refused."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.ranges.amount import UNITS, Limits, amount_text, limits_text, parse_amount, parse_limits
from roslens.judge.ranges.range import Range


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("25 Hz", "Hz", 25),
        ("10 ms", "s", 0.01),
        ("30ms", "s", 0.03),
        ("2 min", "s", 120),
        ("15 µs", "s", 15e-6),
        ("15 μs", "s", 15e-6),
        ("5 MB/s", "B/s", 5e6),
        ("8 Mbit/s", "B/s", 1e6),
        ("1.5 GiB", "B", 1.5 * 2**30),
        ("80 %", "%", 80),
        ("-5 °C", "degC", -5),
        ("70 degC", "degC", 70),
        ("3", "", 3),
        (" .5e1 ", "Hz", 5),
        ("6 /min", "Hz", 0.1),
    ],
)
def test_amounts_in_the_unit_of_the_signal(text: str, unit: str, value: float):
    assert parse_amount(text, unit) == value


@pytest.mark.parametrize(
    ("text", "unit", "reason"),
    [
        ("10 ms", "Hz", "'ms' is not its unit, expected one in Hz, mHz, kHz, MHz, /s, /min"),
        ("10 Mhz", "Hz", "Did you mean 'MHz'"),
        ("10 MB", "B/s", "expected one in B/s, kB/s"),
        ("3 Hz", "", "expected a number without a unit"),
        ("Hz", "Hz", "is not an amount, expected a number and a unit, such as `10 Hz`"),
        ("nan s", "s", "is not an amount"),
        ("1e999 s", "s", "is too great"),
        ("1" * 300, "s", "is not an amount"),
        ("1,5 s", "s", "is not an amount"),
        ("", "", "is not an amount, expected a number"),
    ],
)
def test_other_amounts_are_refused(text: str, unit: str, reason: str):
    with pytest.raises(ValueError, match=reason):
        parse_amount(text, unit)


def test_a_unit_may_be_asked_for():
    with pytest.raises(ValueError, match="has no unit, expected `5 %`"):
        parse_amount("5", "%", bare=False)


@pytest.mark.parametrize(
    ("text", "unit", "low", "high", "percentile"),
    [
        ("25..35 Hz", "Hz", 25, 35, 0),
        ("25 Hz .. 35 Hz", "Hz", 25, 35, 0),
        ("25 Hz..35", "Hz", 25, 35, 0),
        ("500 us..20 ms", "s", 0.0005, 0.02, 0),
        ("10..20", "s", 10, 20, 0),
        ("<= 20 ms", "s", None, 0.02, 0),
        ("≤20ms", "s", None, 0.02, 0),
        ("at most 20 ms", "s", None, 0.02, 0),
        (">= 5 Hz", "Hz", 5, None, 0),
        ("at least 5 Hz", "Hz", 5, None, 0),
        ("30 Hz ± 10 %", "Hz", 27, 33, 0),
        ("30 Hz +- 10%", "Hz", 27, 33, 0),
        ("30 Hz ± 2 Hz", "Hz", 28, 32, 0),
        ("30 ± 2 Hz", "Hz", 28, 32, 0),
        ("30 Hz+/-2", "Hz", 28, 32, 0),
        ("-10 ms ± 10 %", "s", -0.011, -0.009, 0),
        ("50 ± 10", "%", 40, 60, 0),
        ("p95 <= 30 ms", "s", None, 0.03, 95),
        ("p99.9<=30 ms", "s", None, 0.03, 99.9),
        ("p50 25..35 Hz", "Hz", 25, 35, 50),
        ("any", "Hz", None, None, 0),
        ("1", "", 1, 1, 0),
        ("-3..-1", "", -3, -1, 0),
        (".1.. .5", "", 0.1, 0.5, 0),
    ],
)
def test_ranges(text: str, unit: str, low: float | None, high: float | None, percentile: float):
    assert parse_limits(text, unit) == Limits(Range(low, high), percentile)


@pytest.mark.parametrize(
    ("text", "unit", "reason"),
    [
        ("30 Hz", "Hz", "a single value"),
        ("< 20 ms", "s", "leaves out the bound itself, expected `<= 20 ms`"),
        ("35..25 Hz", "Hz", "minimum 35 is above maximum 25"),
        ("25...35 Hz", "Hz", "is not a range"),
        ("80 % ± 10 %", "%", "points or a share of the value"),
        ("30 Hz ± -1 Hz", "Hz", "negative width"),
        ("p0 <= 1 s", "s", "percentile 0"),
        ("p101 <= 1 s", "s", "percentile 101"),
        ("p95", "s", "is not a range"),
        ("p95 p95 <= 1 s", "s", "is not a range"),
        ("25..35 ms", "Hz", "'ms' is not its unit"),
        ("25 ms..35 Hz", "Hz", "25 ms: 'ms' is not its unit"),
        ("fast", "Hz", "'fast' is not a range, expected `25..35 Hz`"),
        ("<= 1e999 s", "s", "too great"),
        ("x" * 300, "s", "too long"),
    ],
)
def test_what_is_no_range_says_why(text: str, unit: str, reason: str):
    with pytest.raises(ValueError, match=reason):
        parse_limits(text, unit)


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.02, "s", "20 ms"),
        (15e-6, "s", "15 us"),
        (90.0, "s", "90 s"),
        (0.0, "s", "0 s"),
        (5e6, "B/s", "5 MB/s"),
        (1.5 * 2**30, "B", "1.5 GiB"),
        (2048 * 2**20, "B", "2 GiB"),
        (12345.0, "B", "12.345 kB"),
        (0.25, "s", "250 ms"),
        (1.5, "s", "1.5 s"),
        (27.0, "Hz", "27 Hz"),
        (3.0, "", "3"),
        (-0.0005, "s", "-500 us"),
    ],
)
def test_amounts_read_as_people_write_them(value: float, unit: str, text: str):
    assert amount_text(value, unit) == text


BOUND = st.one_of(
    st.none(),
    st.floats(-1e12, 1e12),
    st.floats(allow_nan=False, allow_infinity=False),
    st.integers(-999, 999).map(float),
)


@given(BOUND, BOUND, st.sampled_from(sorted(UNITS)), st.sampled_from([0.0, 5.0, 99.9, 100.0]))
def test_a_range_reads_back_as_it_was_printed(low: float | None, high: float | None, unit: str, percentile: float):
    if low is not None and high is not None and low > high:
        low, high = high, low
    limits = Limits(Range(low, high), percentile)
    assert parse_limits(limits_text(limits, unit), unit) == limits


@given(st.text("0123456789.±+-<>= pHzms%e", max_size=20), st.sampled_from(sorted(UNITS)))
def test_any_text_is_a_range_or_refused(text: str, unit: str):
    try:
        limits = parse_limits(text, unit)
    except ValueError:
        return
    assert parse_limits(limits_text(limits, unit), unit) == limits
