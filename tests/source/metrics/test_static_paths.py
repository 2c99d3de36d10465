from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.metrics.complexity import static_paths
from roslens.source.settings import CountingSettings


def paths(facts, **options):
    return static_paths.of_function(facts, CountingSettings(**options))


def python_paths(facts):
    return static_paths.of_python_function(facts, CountingSettings())


@pytest.mark.parametrize(
    ("control", "expected"),
    [
        ("", 1),
        ("return", 1),
        ("and\n  or", 1),
        ("if", 2),
        ("if\nelse", 2),
        ("if\nelif", 3),
        ("if\nelif\nelif\nelse", 4),
        ("if\nif", 4),
        ("if\n  if\n  if", 5),
        ("if\n  if\nelse\n  if\n  if", 6),
        ("for\n  if", 3),
        ("while\n  while", 3),
        ("do", 2),
        ("for\n  if\nloop_else\n  if\n  if", 6),
        ("try\n  if\ncatch\n  if\ncatch", 5),
        ("try\n  if\ncatch\ntry_else\n  if\nfinally\n  if", 10),
        ("ternary", 2),
        ("ternary\n  ternary\n  ternary", 4),
        ("if\n  ternary?\n  if", 6),
        ("if\nelif\n  ternary?\nelse", 6),
        ("switch", 1),
        ("switch\n  default", 1),
        ("switch\n  case\n    break\n  case\n    break", 3),
        ("switch\n  case\n    break\n  default\n    break", 2),
        ("switch\n  case\n  case\n  case\n    break", 2),
        ("switch\n  case\n    if\n    break\n  default", 3),
        ("switch\n  ternary?\n  case\n    break", 4),
        ("preproc_if\n  if\npreproc_else\n  if", 4),
        ("lambda\n  if\nif", 4),
        ("and\n  ternary\n  ternary", 4),
        ("with\n  if\nif", 4),
    ],
)
def test_paths_follow_the_rules(function_of, control, expected):
    assert paths(function_of(control)) == expected


def test_every_case_of_python_is_an_arm(function_of):
    facts = function_of("switch\n  case\n  case\n    return\n  default")
    assert python_paths(facts) == 3
    assert paths(facts) == 2


def test_no_number_grows_without_end(function_of):
    assert paths(function_of("if\n" * 5000)) == static_paths.MOST
    assert paths(function_of("\n".join("  " * depth + "if" for depth in range(1500)))) == 1501


def test_arms_without_a_beginning_do_no_harm(function_of):
    assert paths(function_of("else\nelif\ncatch\nif")) == 2
    assert paths(function_of("case\n  if\nif")) == 2
    assert paths(function_of("if\n      if\n")) == 2


STRUCTURES = ("if", "while", "for", "do", "ternary", "try\ncatch", "if\nelse", "switch\n  case\n    break")


@given(st.lists(st.sampled_from(STRUCTURES), max_size=20))
def test_a_sequence_multiplies_and_has_at_least_as_many_paths_as_decisions(function_of, structures):
    value = paths(function_of("\n".join(structures)))
    assert value == 2 ** len(structures)
    assert value >= 1 + len(structures)
