"""Fan-out of a class."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="fan_out",
    title="Fan-out",
    unit="classes",
    kinds=(EntityKind.CLASS,),
    text="How many other classes a class uses.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of distinct other classes, of the package or not, that the class names in its bases, fields, "
    "signatures or member functions, or of which it calls a static function there",
    source="after Henry and Kafura, Software Structure Metrics Based on Information Flow, IEEE TSE 7(5), 1981, with "
    "classes in place of procedures",
    limits="As cbo, of which this is one direction.",
    decimals=1,
)


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float:
    """Return the number of classes that a class uses."""
    return len(subject.suppliers)
