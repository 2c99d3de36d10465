from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.symbolic.condition import negated, terms_of, under_either, written


@pytest.mark.parametrize(
    ("condition", "opposite"),
    [
        ("a", "not a"), ("not a", "a"), ("a and b", "not (a and b)"), ("not a or b", "not (not a or b)"),
        ("not (a and b)", "a and b"), ("not (a) or (b)", "not (not (a) or (b))"),
        ("no exception", "an exception"), ("an exception", "no exception"),
    ],
)  # fmt: skip
def test_the_opposite_of_a_condition(condition, opposite):
    assert negated(condition) == opposite


@pytest.mark.parametrize(
    ("first", "second", "either"),
    [
        (("a", "b"), ("a", "not b"), ("a",)),
        (("a", "b"), ("a", "c"), ("a", "b or c")),
        (("a",), ("a", "c"), ("a",)),
        (("a",), ("not a",), ()),
        (("a",), ("b", "a and c"), ("a",)),
        (("a",), ("b", "c"), ("a or b and c",)),
        (("a or b",), ("not a",), ()),
        (("a or b",), ("b and c",), ("a or b",)),
        (("a", "b or c"), ("a", "d"), ("a", "b or c or d")),
        (("a and b",), ("a and c",), ("a", "b or c")),
        (("a and b",), ("not a and b",), ("b",)),
        (("a",), ("not a", "b"), ("a or b",)),
        (("no exception",), ("an exception",), ()),
        (("not (a and b)",), ("a",), ()),
        (('x == "a or b"',), ('x == "c"',), ('x == "a or b" or x == "c"',)),
        (("f(a or b)",), ("a",), ("f(a or b) or a",)),
    ],
)
def test_what_holds_wherever_either_does(first, second, either):
    assert under_either(first, second) == either


def test_long_conditions_are_shown_in_part():
    (one,) = under_either(("a" * 500,), ("b" * 500,))
    assert one.startswith("aaa")
    assert len(one) < 310
    assert one.endswith("…")


def test_what_is_shown_in_part_is_not_read():
    assert under_either(("aa…",), ("not aa…",)) == ("aa… or not aa…",)


def test_many_alternatives_stay_short():
    held = ("a0",)
    for number in range(1, 60):
        held = under_either(held, (f"a{number}",))
    assert len(held) == 1
    assert len(held[0]) <= 310
    assert held[0].startswith("a0 or a1 or a2")


@pytest.mark.parametrize("text", ["(a", 'x == "a', "a)", "f(a or b", "", "not ", " or ", "a or ", "((((", "[}"])
def test_text_that_is_broken_is_one_condition_or_some(text):
    assert terms_of(text) is not None


NAMES = "abcd"
FORMULAS = st.recursive(
    st.sampled_from(NAMES),
    lambda inner: st.one_of(
        inner.map(lambda one: f"not ({one})"),
        st.tuples(inner, inner).map(lambda two: f"({two[0]}) and ({two[1]})"),
        st.tuples(inner, inner).map(lambda two: f"({two[0]}) or ({two[1]})"),
    ),
    max_leaves=5,
)
WAYS = [dict(zip(NAMES, values, strict=True)) for values in product((False, True), repeat=len(NAMES))]


def value(condition, way):
    return bool(eval(condition, {"__builtins__": {}}, {**way, "never": False}))


@given(st.lists(FORMULAS, max_size=3), st.lists(FORMULAS, max_size=3))
def test_either_holds_just_where_one_does(first, second):
    either = under_either(first, second)
    if any("…" in one for one in either):
        return
    for way in WAYS:
        holds = any(all(value(one, way) for one in whole) for whole in (first, second))
        assert all(value(one, way) for one in either) is holds


@given(FORMULAS)
def test_what_is_read_and_written_is_the_same(condition):
    terms = terms_of(condition)
    texts = () if terms is None else written(terms)
    if terms is not None and not any("…" in one for one in texts):
        assert all(all(value(one, way) for one in texts) is value(condition, way) for way in WAYS)


@given(FORMULAS)
def test_the_opposite_holds_where_it_does_not(condition):
    assert all(value(negated(condition), way) is not value(condition, way) for way in WAYS)


@given(st.text(alphabet='ab()[]" notrd', max_size=60), st.text(alphabet='ab()[]" notrd', max_size=60))
def test_any_text_is_read(first, second):
    assert isinstance(under_either((first,), (second,)), tuple)
