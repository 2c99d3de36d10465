"""Return statements."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.complexity.countable import countable
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FunctionFacts

QUANTITY = Quantity(
    key="returns",
    title="Returns",
    unit="returns",
    kinds=(EntityKind.FUNCTION,),
    text="How many return statements a function has.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of return (and co_return) statements; the end of the function is none",
    source="RETURN of HIS Source Code Metrics 1.3.1",
    limits="Those of lambdas count in the function around unless `counting.lambdas` is off; those in every arm of "
    "`#if` unless `counting.alternatives` is off. throw, raise and calls that never return are not counted.",
    decimals=1,
)


def of_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return the number of return statements of a function."""
    return countable(facts, counting).get("return", 0)
