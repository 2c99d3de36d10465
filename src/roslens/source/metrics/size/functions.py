"""Number of functions."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FileFacts

QUANTITY = Quantity(
    key="functions",
    title="Functions",
    unit="functions",
    kinds=(EntityKind.FILE,),
    text="How many functions, methods included, are defined.",
    folds=(Fold.SUM,),
    better=Better.NEITHER,
    formula="number of functions with a body",
    source="plain count",
    limits="A function written in two arms of `#if` counts twice, a template once, a lambda not at all; `= default` "
    "and `= delete` have no body.",
)


def of_file(facts: FileFacts, _counting: CountingSettings) -> float:
    """Return the number of functions defined in a file."""
    return len(facts.functions)
