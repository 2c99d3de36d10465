from __future__ import annotations

import pytest

from roslens.source.metrics.complexity import cognitive_complexity
from roslens.source.settings import CountingSettings


def value(facts, **options):
    return cognitive_complexity.of_function(facts, CountingSettings(**options))


@pytest.mark.parametrize("role", ["if", "for", "while", "do", "switch", "catch", "ternary"])
def test_structures_count_one_and_their_nesting(function_of, role):
    assert value(function_of(f"{role}\n  {role}\n    {role}")) == 1 + 2 + 3


@pytest.mark.parametrize("role", ["elif", "else", "loop_else", "try_else"])
def test_arms_count_one_however_deep_and_nest(function_of, role):
    assert value(function_of(f"if\n  if\n  {role}\n    if")) == 1 + 2 + 1 + 3


@pytest.mark.parametrize("role", ["try", "finally", "case", "default", "with", "comprehension", "return", "break"])
def test_the_rest_neither_counts_nor_nests(function_of, role):
    assert value(function_of(f"{role}\n  if")) == 1


def test_a_lambda_nests_but_does_not_count(function_of):
    facts = function_of("lambda\n  if")
    assert value(facts) == 2
    assert value(facts, lambdas=False) == 0


def test_a_condition_is_not_inside_its_structure(function_of):
    assert value(function_of("if\n  ternary?")) == 1 + 1
    assert value(function_of("if\n  ternary")) == 1 + 2


@pytest.mark.parametrize(
    ("written", "sequences"),
    [
        ("and\n  and\n    and", 1),
        ("or\n  and\n  and", 3),
        ("and\nand", 2),
        ("and\n  ternary\n    and", 2),
        ("or\n  and\n    or", 3),
    ],
)
def test_a_sequence_ends_where_the_operator_changes(function_of, written, sequences):
    of_ternaries = written.count("ternary")
    assert value(function_of(written)) == sequences + of_ternaries


def test_recursion_counts_once_however_often_it_is_written(function_of):
    assert value(function_of(counts={"recursion": 3})) == 1
    assert value(function_of("if", counts={"recursion": 3})) == 2


def test_recursion_in_a_lambda_goes_with_the_lambda(function_of):
    facts = function_of(counts={"recursion": 1}, lambda_counts={"recursion": 1})
    assert value(facts, lambdas=False) == 0


def test_a_function_in_a_function_starts_one_deeper(function_of):
    assert value(function_of("if", nested_in="outer")) == 2


def test_directives_count_without_nesting(function_of):
    facts = function_of("if\n  if", counts={"preproc_if": 2, "preproc_else": 1})
    assert value(facts) == 1 + 2 + 3
    assert value(function_of(counts={"preproc_if": 1})) == 1


def test_without_alternatives_only_the_first_arm_is_read_and_no_directive(function_of):
    facts = function_of("if\nwhile#", counts={"preproc_if": 1, "preproc_else": 1})
    assert value(facts) == 4
    assert value(facts, alternatives=False) == 1
