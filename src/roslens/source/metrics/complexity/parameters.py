"""Parameters."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FunctionFacts

QUANTITY = Quantity(
    key="parameters",
    title="Parameters",
    unit="parameters",
    kinds=(EntityKind.FUNCTION,),
    text="How many parameters a function takes.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of declared parameters; those with a default, `*args` and `**kwargs` and an ellipsis count one "
    "each, `(void)` counts none; the object or class that a Python method is called on (`self`, `cls`) does not "
    "count, as `this` does not",
    source="STPAR of QA-C; threshold 6 of High Integrity C++ 4.0, 8.2.2",
    limits="Parameters of lambdas and template parameters do not count.",
    decimals=1,
)


def of_function(facts: FunctionFacts, _counting: CountingSettings) -> float:
    """Return the number of parameters of a function."""
    return facts.parameters
