"""Deepest nesting of control structures."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.complexity.countable import countable_control
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import Control, FunctionFacts

QUANTITY = Quantity(
    key="nesting",
    title="Nesting",
    unit="levels",
    kinds=(EntityKind.FUNCTION,),
    text="How many control structures are nested at the deepest place of a function.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="largest number of if, for, while, do, switch / match and try around any place, that structure included; "
    "elif, else, catch and finally are arms of their structure and as deep as it; 0 without control structures",
    source="STMIF of the ROS, KTH and HIS models as QA-C measures it (maximum nesting of control structures)",
    limits="?:, `with`, comprehensions, plain blocks and cases add no level. A lambda adds none "
    "itself; its content is as deep as its place plus its own structures, unless `counting.lambdas` "
    "is off. `#if` adds none. A nested Python function starts at 0.",
    decimals=1,
)

_STRUCTURES = frozenset({"if", "for", "while", "do", "switch", "try"})
_ARMS = frozenset({"elif", "else", "loop_else", "try_else", "catch", "finally"})
_DEPTHS = 12


def of_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return the number of levels at the deepest place of a function."""
    if _STRUCTURES.isdisjoint(facts.counts):
        return 0
    return _of_control(countable_control(facts, counting))


def _of_control(control: Sequence[Control]) -> int:
    deepest = 0
    # By depth: the levels around what holds the events of that depth, and the levels inside it.
    around, inside = [0] * _DEPTHS, [0] * _DEPTHS
    for event in control:
        role, depth = event.role, event.depth
        while depth + 1 >= len(inside):
            around.append(around[-1])
            inside.append(inside[-1])
        level = deeper = inside[depth] if event.part == "body" else around[depth]
        if role in _STRUCTURES:
            deeper += 1
            deepest = max(deepest, deeper)
        elif role in _ARMS:
            deeper += 1
        depth += 1
        around[depth], inside[depth] = level, deeper
    return deepest
