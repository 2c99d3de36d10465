from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.complexity import cyclomatic_complexity
from roslens.source.metrics.complexity.profiles import ROSLENS
from roslens.source.settings import CountingSettings


@pytest.mark.parametrize("role", sorted(cyclomatic_complexity.DECISIONS))
def test_every_decision_adds_one(function_of, role):
    assert cyclomatic_complexity.of_function(function_of(f"{role}\n{role}"), CountingSettings()) == 3


NO_DECISIONS = """else switch default try finally goto label throw return lambda with assert loop_else try_else
preproc_if preproc_else function break continue yield await"""


@pytest.mark.parametrize("role", NO_DECISIONS.split())
def test_what_decides_nothing_adds_nothing(function_of, role):
    assert cyclomatic_complexity.of_function(function_of(role), CountingSettings()) == 1


def test_what_is_in_a_lambda_and_in_a_later_arm_is_taken_off_once(function_of):
    facts = function_of(
        """
        if
        lambda#
          if#
          while#
        for#
        """
    )
    counted = [
        cyclomatic_complexity.of_function(facts, CountingSettings(lambdas=lambdas, alternatives=alternatives))
        for lambdas in (True, False)
        for alternatives in (True, False)
    ]
    assert counted == [5, 2, 3, 2]


def test_the_profile_of_roslens_takes_the_same_decisions():
    assert cyclomatic_complexity.DECISIONS == ROSLENS


@given(st.dictionaries(st.sampled_from([*sorted(cyclomatic_complexity.DECISIONS), "else", "call"]), st.integers(1, 9)))
def test_it_is_at_least_one_and_grows_with_decisions(function_of, counts):
    value = cyclomatic_complexity.of_function(function_of(counts=counts), CountingSettings())
    assert value >= 1
    more = {**counts, "if": counts.get("if", 0) + 1}
    assert cyclomatic_complexity.of_function(function_of(counts=more), CountingSettings()) == value + 1
