from __future__ import annotations

from roslens.source.metrics.complexity import calls
from roslens.source.settings import CountingSettings


def test_lambdas_and_later_arms_can_be_left_out(function_of):
    facts = function_of(counts={"call": 9}, lambda_counts={"call": 2}, alternative_counts={"call": 3})
    assert calls.of_function(facts, CountingSettings()) == 9
    assert calls.of_function(facts, CountingSettings(lambdas=False)) == 7
    assert calls.of_function(facts, CountingSettings(alternatives=False)) == 6


def test_none_is_zero(function_of):
    assert calls.of_function(function_of(), CountingSettings(lambdas=False)) == 0
