"""Fan-in of a class."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="fan_in",
    title="Fan-in",
    unit="classes",
    kinds=(EntityKind.CLASS,),
    text="How many other classes of the package use a class.",
    folds=(Fold.MEAN, Fold.MAX),
    better=Better.NEITHER,
    formula="number of distinct other classes of the package that name the class in their bases, fields, signatures "
    "or member functions, or call a static function of it there; of Python also by what a package imports and hands on",
    source="after Henry and Kafura, Software Structure Metrics Based on Information Flow, IEEE TSE 7(5), 1981, with "
    "classes in place of procedures",
    limits="As cbo, of which this is one direction. Functions outside classes and other packages that use the class "
    "are not counted.",
    decimals=1,
)


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float:
    """Return the number of classes that use a class."""
    return len(subject.clients)
