from __future__ import annotations

from roslens.source.metrics.complexity import statements
from roslens.source.settings import CountingSettings


def test_lambdas_and_later_arms_can_be_left_out(function_of):
    facts = function_of(counts={"statement": 9}, lambda_counts={"statement": 2}, alternative_counts={"statement": 3})
    assert statements.of_function(facts, CountingSettings()) == 9
    assert statements.of_function(facts, CountingSettings(lambdas=False)) == 7
    assert statements.of_function(facts, CountingSettings(alternatives=False)) == 6


def test_none_is_zero(function_of):
    assert statements.of_function(function_of(), CountingSettings(lambdas=False)) == 0
