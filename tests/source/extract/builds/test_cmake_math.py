"""``math(EXPR)``: numbers as of C."""

import pytest

from roslens.source.extract.builds.cmake_math import whole_number


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3", 7), ("-20 / 8", -2), ("-7 % 3", -1), ("7 / -2", -3), ("1 << 3 + 1", 16), ("0x1f & ~1", 30),
        ("6 ^ 3 | 8", 13), ("(1+2)*(3-5)", -6), ("-17 >> 1", -9), ("2 * -3", -6), ("+4", 4),
    ],
)  # fmt: skip
def test_numbers(expression, value):
    assert whole_number(expression) == value


@pytest.mark.parametrize(
    "expression",
    ["", "1 +", "(1", "1 / 0", "x", "1 2", "1 << 64", "9223372036854775807 + 1", "~" * 50 + "1", "(" * 400],
)
def test_what_is_wrong_or_too_much(expression):
    assert whole_number(expression) is None
