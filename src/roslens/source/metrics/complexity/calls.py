"""Calls."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.complexity.countable import countable
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FunctionFacts

QUANTITY = Quantity(
    key="calls",
    title="Calls",
    unit="calls",
    kinds=(EntityKind.FUNCTION,),
    text="How many places in a function call something.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of call expressions as written: functions, members, function-like macros, casts and "
    "constructions written as calls (`Foo(1)`), each place counted",
    source="STSUB of QA-C (number of function calls), which the ROS, KTH and HIS models bound; CALLS of the HIS "
    "document counts distinct functions instead",
    limits="Operators, implicit conversions, destructors and declarations with arguments (`Foo foo(1);`) do not "
    "count. A macro counts one whatever it expands to. Lambdas and arms of `#if` count unless `counting.lambdas` or "
    "`counting.alternatives` is off.",
    decimals=1,
)


def of_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return the number of call sites in a function."""
    return countable(facts, counting).get("call", 0)
