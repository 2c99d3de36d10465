import ast
from itertools import product

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.symbolic.condition import (
    ALWAYS,
    NEVER,
    NO_EXCEPTION,
    all_of,
    any_of,
    as_written,
    atoms_of,
    formulas_of,
    negated,
    terms_of,
    under_either,
)
from roslens.source.extract.symbolic.text import And, Condition, IsSet, Not, Or, Text, Written


def read(text):
    """Return the condition of a formula of names."""
    return of_tree(ast.parse(text, mode="eval").body)


def of_tree(node):
    match node:
        case ast.BoolOp(op=ast.And(), values=values):
            return all_of([of_tree(one) for one in values])
        case ast.BoolOp(values=values):
            return any_of(*map(of_tree, values))
        case ast.UnaryOp(operand=one):
            return negated(of_tree(one))
    return Written(ast.unparse(node))


@pytest.mark.parametrize(
    ("condition", "opposite"),
    [
        (read("a"), "not a"),
        (read("not a"), "a"),
        (read("a and b"), "not (a and b)"),
        (read("not a or b"), "not (not a or b)"),
        (read("not (a and b)"), "a and b"),
        (Written('x == "a or b"'), 'not (x == "a or b")'),
        (NO_EXCEPTION, "an exception"),
        (Not(NO_EXCEPTION), "no exception"),
    ],
)
def test_the_opposite_of_a_condition(condition, opposite):
    assert str(negated(condition)) == opposite
    assert negated(negated(condition)) == condition


@pytest.mark.parametrize(
    ("condition", "text"),
    [
        ("a and (b or c)", "a and (b or c)"),
        ("a or (b and c)", "a or b and c"),
        ("(not a) and b", "not a and b"),
        ("a and (b and c)", "a and b and c"),
    ],
)
def test_conditions_have_the_brackets_that_they_need(condition, text):
    assert str(read(condition)) == text


def test_without_any_part_it_holds_always_or_never():
    assert (str(ALWAYS), str(NEVER)) == ("always", "never")
    assert str(IsSet(Text.of("imu0"))) == "imu0 is set"


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
        (("not (a and b)",), ("a",), ()),
        (('x == "a or b"',), ('x == "c"',), ("x == 'a or b' or x == 'c'",)),
        (("f(a or b)",), ("a",), ("f(a or b) or a",)),
    ],
)
def test_what_holds_wherever_either_does(first, second, either):
    assert as_written(under_either(tuple(map(read, first)), tuple(map(read, second)))) == either


def test_a_block_ends_or_does_not():
    assert under_either((NO_EXCEPTION,), (Not(NO_EXCEPTION),)) == ()


def test_long_conditions_are_shown_in_part():
    (one,) = as_written(under_either((Written("a" * 500),), (Written("b" * 500),)))
    assert one.startswith("aaa")
    assert len(one) < 310
    assert one.endswith("…")


def test_long_conditions_with_equal_beginnings_are_two():
    first, second = (Written("a" * 500 + end) for end in "xy")
    assert len(under_either((first,), (second,))) == 1
    assert under_either((first,), (Not(second),)) != ()


def test_many_alternatives_stay_short():
    held = (Written("a0"),)
    for number in range(1, 400):
        held = under_either(held, (Written(f"a{number}"),))
    assert len(held) == 1
    assert len(list(atoms_of(held[0]))) <= 201
    (shown,) = as_written(held)
    assert len(shown) <= 310
    assert shown.startswith("a0 or a1 or a2")


NAMES = "abcd"
FORMULAS = st.recursive(
    st.sampled_from(NAMES).map(Written),
    lambda inner: st.one_of(
        inner.map(Not),
        st.lists(inner, max_size=3).map(lambda parts: And(tuple(parts))),
        st.lists(inner, max_size=3).map(lambda parts: Or(tuple(parts))),
    ),
    max_leaves=5,
)
WAYS = [dict(zip(NAMES, values, strict=True)) for values in product((False, True), repeat=len(NAMES))]


def holds(condition, way):
    match condition:
        case Written(text=name):
            return way[name]
        case Not(of=one):
            return not holds(one, way)
        case And(of=parts):
            return all(holds(one, way) for one in parts)
        case Or(of=parts):
            return any(holds(one, way) for one in parts)
    raise TypeError(condition)


@given(st.lists(FORMULAS, max_size=3).map(tuple), st.lists(FORMULAS, max_size=3).map(tuple))
def test_either_holds_just_where_one_does(first, second):
    either = under_either(first, second)
    if {str(one) for part in either for one in atoms_of(part)} <= set(NAMES):
        for way in WAYS:
            expected = any(all(holds(one, way) for one in whole) for whole in (first, second))
            assert all(holds(one, way) for one in either) is expected


@given(FORMULAS)
def test_terms_hold_where_the_condition_does(condition):
    terms = terms_of(condition)
    if terms is not None:
        for way in WAYS:
            assert all(holds(one, way) for one in formulas_of(terms)) is holds(condition, way)


@given(FORMULAS)
def test_the_opposite_holds_where_it_does_not(condition):
    assert all(holds(negated(condition), way) is not holds(condition, way) for way in WAYS)


@given(FORMULAS)
def test_what_is_shown_is_read_as_the_same(condition):
    shown = str(condition)
    if "always" not in shown and "never" not in shown:
        assert all(holds(read(shown), way) is holds(condition, way) for way in WAYS)


@given(FORMULAS)
def test_conditions_are_kept_as_they_are(condition):
    assert msgspec.msgpack.decode(msgspec.msgpack.encode(condition), type=Condition) == condition
