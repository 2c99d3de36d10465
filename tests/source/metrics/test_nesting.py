from __future__ import annotations

from itertools import pairwise

import pytest

from roslens.source.metrics.complexity import nesting
from roslens.source.settings import CountingSettings


def value(facts, **options):
    return nesting.of_function(facts, CountingSettings(**options))


@pytest.mark.parametrize("role", ["if", "for", "while", "do", "switch", "try"])
def test_structures_are_levels(function_of, role):
    assert value(function_of(f"{role}\n  {role}\n{role}")) == 2


@pytest.mark.parametrize("role", ["elif", "else", "catch", "finally", "loop_else", "try_else"])
def test_an_arm_is_as_deep_as_its_structure(function_of, role):
    assert value(function_of(f"if\n{role}\n  if")) == 2


@pytest.mark.parametrize("role", ["case", "ternary", "with", "lambda", "preproc_if", "preproc_else", "comprehension"])
def test_the_rest_is_no_level(function_of, role):
    assert value(function_of(f"if\n  {role}\n    if")) == 2
    assert value(function_of(role)) == 0


def test_a_lambda_in_a_condition_is_not_inside(function_of):
    assert value(function_of("if\n  lambda?\n    if")) == 1


def test_a_lambda_can_be_left_out(function_of):
    assert value(function_of("if\n  lambda\n    if\n      if"), lambdas=False) == 1


def test_it_is_never_more_than_the_depth_of_the_events(function_of):
    chain = [f"{'  ' * depth}{role}" for depth, role in enumerate(["if", "case", "for", "with", "while"] * 3)]
    values = [value(function_of("\n".join(chain[: length + 1]))) for length in range(len(chain))]
    assert all(0 <= after - before <= 1 for before, after in pairwise(values))
    assert values[-1] == 9


def test_a_thousand_levels_are_no_trouble(function_of):
    assert value(function_of("\n".join("  " * depth + "if" for depth in range(1000)))) == 1000
