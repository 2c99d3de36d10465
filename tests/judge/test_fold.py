from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.quality.fold import fold_parts, fold_steps, folded_from, folded_keys
from roslens.model.entity import Entity, EntityKind
from roslens.model.quantity import Fold, Quantity

FUNCTION, CLASS, FILE, PACKAGE = EntityKind.FUNCTION, EntityKind.CLASS, EntityKind.FILE, EntityKind.PACKAGE

numbers = st.integers(min_value=-10_000, max_value=10_000).map(float)


def quantity(*folds: Fold, kinds: tuple[EntityKind, ...] = (FUNCTION,), key: str = "q") -> Quantity:
    return Quantity(key=key, title="Q", unit="", kinds=kinds, text="", folds=folds)


def entity(kind: EntityKind, **values: float) -> Entity:
    return Entity(id=f"{kind.value}:x", kind=kind, name="x", values=values)


def fold(wanted: Quantity, values: list[float]) -> dict[str, float]:
    return fold_parts(fold_steps([wanted], FILE), [entity(FUNCTION, q=value) for value in values])


def test_first_fold_has_the_key_and_the_others_say_how():
    assert fold(quantity(Fold.MEAN, Fold.MAX, Fold.MIN, Fold.SUM), [1.0, 2.0, 6.0]) == {
        "q": 3.0,
        "q.max": 6.0,
        "q.min": 1.0,
        "q.sum": 9.0,
    }


def test_keys_are_those_of_the_values():
    wanted = quantity(Fold.SUM, Fold.MAX)
    assert folded_keys(wanted) == tuple(fold(wanted, [1.0])) == ("q", "q.max")


def test_nothing_measured_is_absent_and_not_zero():
    assert fold(quantity(Fold.SUM, Fold.MEAN, Fold.MAX, Fold.MIN), []) == {}


@given(numbers)
def test_fold_of_one_is_that_one(value):
    assert set(fold(quantity(*Fold), [value]).values()) == {value}


@given(st.lists(numbers, min_size=1), st.randoms())
def test_order_does_not_matter_and_the_mean_lies_between(values, random):
    folded = fold(quantity(Fold.MEAN, Fold.MIN, Fold.MAX, Fold.SUM), values)
    assert folded["q.min"] <= folded["q"] <= folded["q.max"]
    random.shuffle(values)
    assert fold(quantity(Fold.MEAN, Fold.MIN, Fold.MAX, Fold.SUM), values) == folded


@given(st.lists(st.lists(numbers, min_size=1), min_size=1))
def test_sum_and_max_may_be_taken_file_by_file(files):
    wanted = quantity(Fold.SUM, Fold.MAX)
    at_once = fold(wanted, [value for values in files for value in values])
    step_by_step = [fold(wanted, values) for values in files]
    assert at_once["q"] == sum(part["q"] for part in step_by_step)
    assert at_once["q.max"] == max(part["q.max"] for part in step_by_step)


@pytest.mark.parametrize(
    ("kinds", "to", "source"),
    [
        ((FUNCTION,), FILE, FUNCTION),
        ((FUNCTION,), PACKAGE, FUNCTION),
        ((CLASS,), PACKAGE, CLASS),
        ((FUNCTION, FILE), PACKAGE, FILE),
        ((FUNCTION, FILE), FILE, None),
        ((FILE, PACKAGE), PACKAGE, None),
        ((PACKAGE,), FILE, None),
        ((FUNCTION,), EntityKind.NODE, None),
    ],
)
def test_values_come_from_the_nearest_level_that_is_measured(kinds, to, source):
    assert folded_from(quantity(Fold.SUM, kinds=kinds), to) is source


def test_a_quantity_without_folds_stays_where_it_is():
    assert folded_from(quantity(), PACKAGE) is None


def test_mean_of_a_package_is_over_functions_and_not_over_files():
    parts = [
        entity(FILE, q=10.0, lines=7.0),
        entity(FUNCTION, q=1.0),
        entity(FUNCTION, q=3.0),
        entity(FILE, lines=5.0),
        entity(FUNCTION, q=8.0),
        entity(FUNCTION, other=99.0),
        entity(CLASS, q=50.0),
    ]
    lines = quantity(Fold.SUM, kinds=(FUNCTION, FILE), key="lines")
    assert fold_parts(fold_steps([quantity(Fold.MEAN, Fold.MAX), lines], PACKAGE), parts) == {
        "q": 4.0,
        "q.max": 8.0,
        "lines": 12.0,
    }


def test_parts_without_the_quantity_leave_no_trace():
    assert fold_parts(fold_steps([quantity(Fold.MEAN)], FILE), [entity(FUNCTION, other=1.0)]) == {}
