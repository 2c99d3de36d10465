"""Numbers for programs."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.report.writing.numbers import plain, written


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (3, "3"),
        (3.0, "3"),
        (-0.0, "0"),
        (2.5, "2.5"),
        (0.1, "0.1"),
        (1e300, "1e+300"),
        (2.0**53, "9007199254740992"),
        (2**70, "1180591620717411303424"),
        (None, ""),
        (float("nan"), ""),
        (float("-inf"), ""),
    ],
)
def test_written(value, expected):
    assert written(value) == expected


@given(st.one_of(st.integers(), st.floats(allow_nan=False, allow_infinity=False)))
def test_a_number_comes_back(value):
    assert json.loads(written(value)) == value
    assert plain(value) == value
