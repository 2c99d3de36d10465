"""The words of a constraint."""

from __future__ import annotations

import pytest

from roslens.judge.constraint import Constraint, spoken, verb
from roslens.judge.range import Range
from roslens.model.entity import EntityKind


def constraint(minimum: float | None = None, maximum: float | None = None, **more: object) -> Constraint:
    return Constraint("x", EntityKind.FUNCTION, "x", Range(minimum, maximum), **more)  # type: ignore[arg-type]


def message(of: Constraint, value: float, side: str, entity: str, model: str) -> str:
    before, between, behind = of.sentence(side, model)
    return f"{before}{entity}{between}{of.value_text(value, side)}{behind}"


def test_a_message_says_value_bound_and_model():
    complexity = constraint(maximum=15, subject="Cyclomatic complexity")
    said = message(complexity, 23.0, "max", "Foo::bar", "ros")
    assert said == "cyclomatic complexity of Foo::bar is 23; at most 15 (ros)"


def test_a_message_has_its_unit_and_its_number():
    ratio = constraint(20, 30, subject="Comment ratio", unit="%", decimals=1)
    assert message(ratio, 12.345, "min", "a.cpp", "his") == "comment ratio of a.cpp is 12.3 %; at least 20 % (his)"
    lines = constraint(maximum=40, subject="Lines of code", unit="lines")
    assert message(lines, 41, "max", "f", "m") == "lines of code of f are 41; at most 40 (m)"


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
    ],
)
def test_one_or_many(title: str, word: str):
    assert verb(title) == word
