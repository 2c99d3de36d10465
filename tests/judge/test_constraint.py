"""The words of a constraint."""

from __future__ import annotations

import pytest

from roslens.judge.quality.constraint import Constraint, spoken, verb
from roslens.judge.ranges.range import Range
from roslens.model.entity import EntityKind


def constraint(minimum: float | None = None, maximum: float | None = None, **more: object) -> Constraint:
    return Constraint("x", EntityKind.FUNCTION, "x", Range(minimum, maximum), **more)  # type: ignore[arg-type]


def test_a_message_says_the_number_the_bound_and_how_far_it_is_exceeded():
    complexity = constraint(maximum=15, subject="Cyclomatic complexity")
    assert complexity.breach_text(23.0, "max") == "cyclomatic complexity 23 (limit 15, 1.5 x)"
    calls = constraint(maximum=10, subject="Calls")
    assert calls.breach_text(30, "max") == "30 calls (limit 10, 3.0 x)"
    assert calls.breach_text(5000, "max") == "5000 calls (limit 10, 500 x)"
    assert calls.breach_text(6.7e6, "max").endswith("(limit 10, over 1,000 x)")


def test_a_message_has_its_unit_and_no_ratio_where_there_is_none():
    ratio = constraint(20, 30, subject="Comment ratio", unit="%", decimals=1)
    assert ratio.breach_text(12.345, "min") == "comment ratio 12.3 % (at least 20 %)"
    assert ratio.breach_text(31, "max") == "comment ratio 31 % (limit 30 %, 1.03 x)"
    none = constraint(maximum=0, subject="Lines of code", unit="lines")
    assert none.breach_text(41, "max") == "41 lines of code (limit 0)"


def test_what_is_barely_too_much_does_not_read_as_if_it_were_not():
    assert constraint(maximum=1000, subject="Calls").breach_text(1001, "max") == "1001 calls (limit 1000, 1.01 x)"


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [(15.04, 0, "15.04"), (15.4, 0, "15.4"), (16.0, 2, "16"), (15.0000001, 0, "15.0000001"), (22.26, 1, "22.3")],
)
def test_a_value_is_never_rounded_to_what_would_be_fine(value: float, decimals: int, text: str):
    assert constraint(maximum=15, decimals=decimals).value_text(value, "max") == text


def test_a_value_below_is_never_rounded_up_to_the_bound():
    assert constraint(20, decimals=0).value_text(19.96, "min") == "19.96"
    assert constraint(20, decimals=0).value_text(19.2, "min") == "19"
    assert constraint(20, decimals=0).value_text(19.9999999999, "min") == "19.9999999999"


def test_sides_and_bounds():
    assert constraint(1, 15).sides == ("max", "min")
    assert constraint(maximum=15).sides == ("max",)
    assert constraint(1).sides == ("min",)
    assert (constraint(1, 15).bound("max"), constraint(1, 15).bound("min")) == (15, 1)
    with pytest.raises(ValueError, match="x has no min"):
        constraint(maximum=15).bound("min")


@pytest.mark.parametrize(
    ("title", "text"),
    [("Nesting", "nesting"), ("LCOM4", "LCOM4"), ("CC per function", "CC per function"), ("#RQV", "#RQV"), ("X", "X")],
)
def test_titles_inside_a_sentence(title: str, text: str):
    assert spoken(title) == text


@pytest.mark.parametrize(
    ("title", "word"),
    [
        ("Lines of code", "are"),
        ("Executable lines", "are"),
        ("Weighted methods per class", "are"),
        ("Methods available", "are"),
        ("Cyclomatic complexity", "is"),
        ("Number of children", "is"),
        ("Nesting", "is"),
        ("Analysis status", "is"),
        ("CBO", "is"),
        ("Coupling between classes", "is"),
    ],
)
def test_one_or_many(title: str, word: str):
    assert verb(title) == word


def test_long_numbers_are_divided_into_thousands():
    paths = constraint(maximum=250, subject="Static paths")
    assert paths.breach_text(6_709_248, "max") == "6,709,248 static paths (limit 250, over 1,000 x)"
    assert paths.breach_text(9_232, "max") == "9232 static paths (limit 250, 36.9 x)"
