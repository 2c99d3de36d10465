"""Weighted methods per class."""

from __future__ import annotations

from collections import Counter

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.metrics.complexity import cyclomatic_complexity
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="wmc",
    title="Weighted methods per class",
    unit="",
    kinds=(EntityKind.CLASS,),
    text="How complex all methods of a class are together.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="sum of cyclomatic_complexity over the methods of the class; 1 for each that has no body in the package "
    "(pure virtual, defaulted, deleted, defined elsewhere)",
    source="Chidamber and Kemerer, A Metrics Suite for Object Oriented Design, IEEE TSE 20(6), 1994, with McCabe's "
    "number as weight",
    limits="Methods are matched to their bodies by class and name, so overloads without a body hide behind those "
    "with several. The 2016 paper's WMC is `methods`. Options of counting act as on cyclomatic_complexity.",
    decimals=1,
)


def of_class(subject: ClassInPackage, counting: CountingSettings) -> float:
    """Return the sum of the complexity of all methods of a class."""
    written = sum(cyclomatic_complexity.of_function(body, counting) for body in subject.bodies)
    missing = Counter(method.name for method in subject.facts.methods)
    missing.subtract(body.name for body in subject.bodies)
    return written + sum(number for number in missing.values() if number > 0)
