"""Cognitive complexity."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.complexity.countable import countable, countable_control
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import Control, FunctionFacts

QUANTITY = Quantity(
    key="cognitive_complexity",
    title="Cognitive complexity",
    unit="",
    kinds=(EntityKind.FUNCTION,),
    text="How hard the flow of a function is to follow: breaks in it count, and count more the deeper they are nested.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="sum over the function of: if, ?:, switch / match, for, while, do, catch / except: 1 + nesting; elif, "
    "else (of loops and try, too): 1; goto: 1; #if, #elif and #else: 1; every sequence of like && or ||: 1; a "
    "function that calls itself: 1. Nesting rises by one inside each of the structures named first, inside elif and "
    "else, inside a lambda, and for a function inside a function",
    source="SonarSource, Cognitive Complexity, version 1.7, 2023, appendix B",
    limits="Recursion through other functions is not seen. `a || b && c || d` counts two sequences, as clang-tidy "
    "does; the white paper's reading from left to right has three. A comprehension counts none. #if neither nests "
    "nor is nested. A Python function inside a function is measured on its own, with nesting 1, and not added to the "
    "outer one. Without `counting.alternatives` only the first arm of an `#if` counts, and `#if` none; without "
    "`counting.lambdas` lambdas are passed over.",
    decimals=1,
)

_STRUCTURES = frozenset({"if", "ternary", "switch", "for", "while", "do", "catch"})
_ARMS = frozenset({"elif", "else", "loop_else", "try_else"})
_OPERATORS = frozenset({"and", "or"})
_PREPROCESSOR = frozenset({"preproc_if", "preproc_else"})
_DEPTHS = 12
_COUNTED = _STRUCTURES | _ARMS | _OPERATORS | _PREPROCESSOR | {"goto"}


def of_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return the cognitive complexity of a function."""
    counts = facts.counts
    recursion = "recursion" in counts and "recursion" in countable(facts, counting)
    if _COUNTED.isdisjoint(counts):
        return 1 if recursion else 0
    directives = sum([counts.get(role, 0) for role in _PREPROCESSOR]) if counting.alternatives else 0
    return recursion + directives + _of_control(countable_control(facts, counting), 1 if facts.nested_in else 0)


def _of_control(control: Sequence[Control], start: int) -> int:
    total = 0
    # By depth: the role around events of that depth, the nesting it stands at, and the nesting inside it.
    roles, around, inside = ["function"] * _DEPTHS, [start] * _DEPTHS, [start] * _DEPTHS
    for event in control:
        role, depth = event.role, event.depth
        while depth + 1 >= len(inside):
            roles.append(roles[-1])
            around.append(around[-1])
            inside.append(inside[-1])
        nesting = deeper = inside[depth] if event.part == "body" else around[depth]
        if role in _STRUCTURES:
            deeper += 1
            total += deeper
        elif role in _ARMS:
            deeper += 1
            total += 1
        elif role in _OPERATORS:
            total += roles[depth] != role
        elif role == "goto":
            total += 1
        elif role == "lambda":
            deeper += 1
        depth += 1
        roles[depth], around[depth], inside[depth] = role, nesting, deeper
    return total
