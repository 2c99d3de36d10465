"""Conditions of REP-149, held against catkin_pkg."""

from __future__ import annotations

import pytest
from catkin_pkg.condition import evaluate_condition
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.workspace.conditions import ConditionError, environment_of, evaluate

ENVIRONMENT = {"ROS_VERSION": "2", "ROS_DISTRO": "jazzy", "A": "a b"}


@pytest.mark.parametrize(
    ("condition", "holds"),
    [
        ("$ROS_VERSION == 2", True),
        ("$ROS_VERSION==1", False),
        ("$ROS_VERSION != 1", True),
        ("$ROS_DISTRO < kilted", True),
        ("$ROS_DISTRO <= jazzy", True),
        ("$ROS_DISTRO > jazzy", False),
        ("$ROS_DISTRO >= jazzy", True),
        ("'10' < '9'", True),
        ("$UNSET == ''", True),
        ('$A == "a b"', True),
        ("2 == $ROS_VERSION", True),
        ("a == b or c == c and d == e", False),
        ("(a == a or c == d) and d == d", True),
        ("a == a or c == d and d == e", True),
        ("((a == a))", True),
        ("and == and", True),
        ("\t$ROS_VERSION\n==  2 ", True),
    ],
)
def test_what_holds(condition: str, holds: bool) -> None:
    assert evaluate(condition, ENVIRONMENT) is holds


@pytest.mark.parametrize(
    ("condition", "found", "offset"),
    [
        ("", "end of condition", 0),
        ("$ROS_VERSION", "end of condition", 12),
        ("$ROS_VERSION = 2", "=", 13),
        ("$ROS_VERSION == ", "end of condition", 16),
        ("$ == 2", "$", 0),
        ("(a == b", "end of condition", 7),
        ("a == b)", ")", 6),
        ("a == b c", "c", 7),
        ("a == b and", "end of condition", 10),
        ("a == 'b", "'", 5),
        ("not a == b", "a", 4),
        ("a.b == c", ".", 1),
        ('a == b "and" c == d', "and", 8),
        ("(" * 60 + "a == b" + ")" * 60, "(", 50),
    ],
)
def test_what_cannot_be_read(condition: str, found: str, offset: int) -> None:
    with pytest.raises(ConditionError) as caught:
        evaluate(condition, ENVIRONMENT)
    assert (caught.value.found, caught.value.offset) == (found, offset)
    assert caught.value.expected


def test_a_condition_that_is_too_long_is_refused() -> None:
    with pytest.raises(ConditionError, match="2000"):
        evaluate("a == b or " * 300, ENVIRONMENT)


def test_the_environment_has_what_rep_149_names_and_defaults_to_ros_2() -> None:
    assert environment_of({"HOME": "/root", "ROS_DISTRO": "noetic", "ROS_VERSION": "1"}) == {
        "ROS_DISTRO": "noetic",
        "ROS_PYTHON_VERSION": "3",
        "ROS_VERSION": "1",
    }
    assert environment_of({"ROS_DISTRO": ""}) == {"ROS_PYTHON_VERSION": "3", "ROS_VERSION": "2"}


OPERANDS = st.sampled_from(("$ROS_VERSION", "$A", "$NONE", "2", "jazzy", "-_x", '"a b"', "'2'", '""', "'('"))
COMPARISONS = st.builds(
    lambda left, operator, right, space: space.join((left, operator, right)),
    OPERANDS,
    st.sampled_from(("==", "!=", "<", "<=", ">", ">=")),
    OPERANDS,
    st.sampled_from(("", " ", "  ")),
)
CONDITIONS = st.recursive(
    COMPARISONS,
    lambda inner: (
        st.builds("({})".format, inner)
        | st.builds("{} and {}".format, inner, inner)
        | st.builds("{} or {}".format, inner, inner)
    ),
    max_leaves=5,
)


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")
@given(condition=CONDITIONS)
@settings(max_examples=100, deadline=None)
def test_conditions_hold_when_catkin_pkg_says_so(condition: str) -> None:
    assert evaluate(condition, ENVIRONMENT) == evaluate_condition(condition, ENVIRONMENT)


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")
@given(parts=st.lists(st.sampled_from(("$A", "a", "==", "<", "and", "or", "(", ")", "'", "$", "=")), max_size=7))
@settings(max_examples=150, deadline=None)
def test_conditions_are_refused_when_catkin_pkg_refuses(parts: list[str]) -> None:
    condition = " ".join(parts)
    try:
        ours: object = evaluate(condition, ENVIRONMENT)
    except ConditionError:
        ours = "refused"
    try:
        theirs: object = evaluate_condition(condition, ENVIRONMENT)
    except ValueError:
        theirs = "refused"
    assert ours == theirs


@given(condition=st.text(max_size=60))
@settings(max_examples=200, deadline=None)
def test_any_text_is_answered(condition: str) -> None:
    offset = 0
    try:
        evaluate(condition, ENVIRONMENT)
    except ConditionError as error:
        offset = error.offset
    assert 0 <= offset <= len(condition)
