"""Statements."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.complexity.countable import countable
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FunctionFacts

QUANTITY = Quantity(
    key="statements",
    title="Statements",
    unit="statements",
    kinds=(EntityKind.FUNCTION,),
    text="Simple statements of a function: its length without regard to layout.",
    folds=(Fold.SUM, Fold.MAX),
    formula="number of expression statements, jumps (return, break, continue, goto, throw, raise) and declarations "
    "with an initialiser; structures count by what is in them",
    source="STMT of HIS Source Code Metrics 1.3.1, which counts structures as well",
    limits="Lambdas and arms of `#if` count unless `counting.lambdas` or `counting.alternatives` is off.",
)


def of_function(facts: FunctionFacts, counting: CountingSettings) -> float:
    """Return the number of simple statements in a function."""
    return countable(facts, counting).get("statement", 0)
