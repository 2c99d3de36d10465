"""Numbers for readers."""

from __future__ import annotations

import pytest

from roslens.dashboard.charts.figures import compact, number, share
from roslens.model.words.plural import plural


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [
        (None, 0, "\N{EN DASH}"),
        (1234567, 0, "1,234,567"),
        (12.345, 1, "12.3"),
        (2.5, 0, "2.5"),
        (0.125, 0, "0.12"),
        (3.0, 2, "3.00"),
        (float("inf"), 0, "inf"),
        (float("nan"), 0, "nan"),
    ],
)
def test_a_number_is_grouped_and_keeps_what_matters(value: float | None, decimals: int, text: str) -> None:
    assert number(value, decimals) == text


@pytest.mark.parametrize(("part", "text"), [(0, "0 %"), (1, "< 1 %"), (50, "25 %"), (199, "> 99 %"), (200, "100 %")])
def test_a_share_is_never_a_false_nothing_or_everything(part: int, text: str) -> None:
    assert share(part, 200) == text
    assert share(part, 0) == "\N{EN DASH}"


def test_words_follow_their_number() -> None:
    assert plural(1, "package") == "1 package"
    assert plural(1200, "package") == "1,200 packages"
    assert plural(2, "entry", "entries") == "2 entries"


def test_scripts_get_four_digits() -> None:
    assert [compact(value) for value in (3.0, 0.123456, 12345.678, 2_000_000.0)] == [
        "3",
        "0.1235",
        "1.235e+04",
        "2e+06",
    ]
