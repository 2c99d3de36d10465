from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.complexity.countable import countable, countable_control
from roslens.source.settings import CountingSettings

ALL = CountingSettings()
CONTROL = """
if
  lambda
    for
    lambda#
      while#
  return
lambda#
  and#
goto#
"""


def roles(facts, **options):
    return " ".join(event.role for event in countable_control(facts, CountingSettings(**options)))


def test_by_default_everything_counts_and_nothing_is_copied(function_of):
    facts = function_of(CONTROL)
    assert countable(facts, ALL) is facts.counts
    assert countable_control(facts, ALL) is facts.control


def test_without_lambdas_what_is_inside_is_left_out_and_the_lambda_stays(function_of):
    assert roles(function_of(CONTROL), lambdas=False) == "if lambda return lambda goto"


def test_without_alternatives_the_first_arm_stays(function_of):
    assert roles(function_of(CONTROL), alternatives=False) == "if lambda for return"


@pytest.mark.parametrize("lambdas", [True, False])
@pytest.mark.parametrize("alternatives", [True, False])
def test_counts_and_control_agree(function_of, lambdas, alternatives):
    facts = function_of(CONTROL)
    settings = CountingSettings(lambdas=lambdas, alternatives=alternatives)
    left = [event.role for event in countable_control(facts, settings)]
    assert countable(facts, settings) == {role: left.count(role) for role in left}


def test_calls_in_both_are_never_less_than_none(function_of):
    facts = function_of(counts={"call": 2}, lambda_counts={"call": 2}, alternative_counts={"call": 2})
    assert countable(facts, CountingSettings(lambdas=False, alternatives=False)) == {}


events = st.tuples(
    st.integers(0, 3), st.sampled_from(["if", "lambda", "and", "return"]), st.sampled_from(["", "?", "#", "?#"])
)


@given(st.lists(events), st.booleans(), st.booleans())
def test_counts_and_control_agree_whatever_the_function(function_of, written, lambdas, alternatives):
    facts = function_of("\n".join(f"{'  ' * depth}{role}{marks}" for depth, role, marks in written))
    settings = CountingSettings(lambdas=lambdas, alternatives=alternatives)
    left = [event.role for event in countable_control(facts, settings)]
    assert countable(facts, settings) == {role: left.count(role) for role in left}
