"""Cyclomatic complexity as several tools count it, from the same facts.

McCabe's number (McCabe 1976) of a structured function with one entry and one exit is its number of decisions plus
one. Tools differ in what they take for a decision; a profile is such a choice.

=========== ============ ======================================================================================
profile     languages    decisions
=========== ============ ======================================================================================
``roslens`` C++, Python  every place where the source, as written, can go two ways: ``if``, ``elif``, loops,
                         ``case``, ``catch``, ``?:``, ``and``, ``or``, comprehensions and their ``if``, guards
``lizard``  C++, Python  as lizard 1.24: keywords and signs, wherever they stand
``radon``   Python       as radon 6: also ``assert`` and the ``else`` of loops and ``try``
``mccabe``  Python       as the ``mccabe`` checker in ruff (C901): statements only, nested functions included
=========== ============ ======================================================================================

Where they differ, and how often, is in ``docs/reference/metrics/disagreements.md``.
"""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.source.syntax.facts import FunctionFacts

_BRANCHES = ("if", "elif", "for", "while", "catch", "ternary", "and", "or", "case")

ROSLENS = frozenset((*_BRANCHES, "do", "guard", "comprehension", "comprehension_if"))
_LIZARD_CPP = frozenset((*_BRANCHES, "do", "preproc_if", "preproc_elif"))
_LIZARD_PYTHON = frozenset((*_BRANCHES, "default", "finally", "guard", "comprehension", "comprehension_if"))
_RADON = frozenset((*_BRANCHES, "assert", "loop_else", "try_else", "comprehension", "comprehension_if"))
_MCCABE = frozenset(("if", "elif", "for", "while", "catch", "try_else", "case", "function"))


class Profile(msgspec.Struct, frozen=True):
    """What a profile counts in one language: the roles, and what it does with functions inside the function.

    ``but`` are roles that are counted besides another one and taken off again. ``aside`` is whether it looks into
    assertions, local classes and the headers of nested functions; ``nested`` whether the decisions of nested
    functions are the outer function's too; ``own_header`` whether defaults and annotations count for the function
    itself and not for what it is defined in.
    """

    roles: frozenset[str]
    but: frozenset[str] = frozenset()
    aside: bool = True
    nested: bool = False
    own_header: bool = False


PROFILES: dict[tuple[str, str], Profile] = {
    ("roslens", "cpp"): Profile(ROSLENS),
    ("roslens", "python"): Profile(ROSLENS),
    ("lizard", "cpp"): Profile(_LIZARD_CPP, but=frozenset({"preproc_ifndef"})),
    ("lizard", "python"): Profile(_LIZARD_PYTHON, own_header=True),
    ("radon", "python"): Profile(_RADON, but=frozenset({"catch_group"}), aside=False),
    ("mccabe", "python"): Profile(_MCCABE, nested=True),
}
"""Name of the profile and syntax to what it counts."""


def cyclomatic(
    profile: str,
    syntax: str,
    function: FunctionFacts,
    functions: Sequence[FunctionFacts] = (),
    *,
    lambdas: bool = True,
    alternatives: bool = True,
) -> int:
    """Return the cyclomatic complexity of a function.

    Args:
        profile: ``roslens``, ``lizard``, ``radon`` or ``mccabe``.
        syntax: ``cpp`` or ``python``.
        function: the function.
        functions: all functions of its file; only profiles of Python that look into nested functions need them.
        lambdas: whether what stands inside lambdas counts.
        alternatives: whether second and later arms of ``#if`` count.

    Raises:
        ValueError: there is no such profile for the syntax.
    """
    counted = PROFILES.get((profile, syntax))
    if counted is None:
        known = ", ".join(f"{name} for {language}" for name, language in PROFILES)
        raise ValueError(f"no profile {profile!r} for {syntax!r}: expected one of {known}")
    roles = counted.roles
    number = 1 + _total(function.counts, roles) - _total(function.counts, counted.but)
    if not lambdas:
        number -= _total(function.lambda_counts, roles)
    if not alternatives:
        number -= _total(function.alternative_counts, roles)
    if not counted.aside:
        number -= _total(function.aside_counts, roles)
    if counted.nested or counted.own_header:
        number += _of_nested(counted, function, functions)
    return number


def _of_nested(profile: Profile, function: FunctionFacts, functions: Sequence[FunctionFacts]) -> int:
    """Return what headers and nested functions add or take away."""
    number = _total(function.header_counts, profile.roles) if profile.own_header else 0
    for inner in functions:
        if inner.nested_in and function.line < inner.line and inner.end_line <= function.end_line:
            if profile.nested:
                number += _total(inner.counts, profile.roles)
            if profile.own_header and inner.nested_in == function.qualified_name:
                number -= _total(inner.header_counts, profile.roles)
    return number


def _total(counts: dict[str, int], roles: frozenset[str]) -> int:
    return sum(count for role, count in counts.items() if role in roles)
