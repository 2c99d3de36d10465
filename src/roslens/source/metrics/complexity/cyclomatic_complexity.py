"""Cyclomatic complexity."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.complexity.countable import countable
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FunctionFacts

QUANTITY = Quantity(
    key="cyclomatic_complexity",
    title="Cyclomatic complexity",
    unit="",
    kinds=(EntityKind.FUNCTION,),
    text="How many independent paths lead through a function: as many tests are needed to take every branch.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="1 + number of if, elif (else if), for, while, do, case (not default), catch / except, ?:, && and ||; in "
    "Python also every for and if of a comprehension and the if of a match case",
    source="McCabe, A Complexity Measure, IEEE TSE 2(4), 1976, with conditions counted one by one (his section V)",
    limits="Decisions are counted as written: a macro that hides a branch counts none. Lambdas count in the enclosing "
    "function unless `counting.lambdas` is off; all arms of `#if` count unless `counting.alternatives` is off "
    "(then the first arm alone), `#if` itself never does. A nested Python function is measured separately. "
    "goto, throw, assert, finally, else and `else` of a loop count none.",
    minimum=1,
    decimals=1,
)

DECISIONS = frozenset(
    {
        "if",
        "elif",
        "for",
        "while",
        "do",
        "case",
        "catch",
        "ternary",
        "and",
        "or",
        "comprehension",
        "comprehension_if",
        "guard",
    }
)
"""Roles that are a decision."""


def of_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return 1 plus the number of decisions in a function."""
    counts = countable(facts, counting)
    return 1 + sum([number for role, number in counts.items() if role in DECISIONS])
