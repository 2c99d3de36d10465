"""Number of classes."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.settings import CountingSettings
from roslens.source.syntax.facts import FileFacts

QUANTITY = Quantity(
    key="classes",
    title="Classes",
    unit="classes",
    kinds=(EntityKind.FILE,),
    text="How many classes, structs and unions are defined.",
    folds=(Fold.SUM,),
    better=Better.NEITHER,
    formula="number of classes, structs and unions with a body",
    source="plain count",
    limits="Forward declarations and enumerations do not count; every specialisation of a template does.",
)


def of_file(facts: FileFacts, _counting: CountingSettings) -> float:
    """Return the number of classes defined in a file."""
    return len(facts.classes)
