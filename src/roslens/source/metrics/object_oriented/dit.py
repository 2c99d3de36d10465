"""Depth of inheritance tree."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="dit",
    title="Depth of inheritance",
    unit="levels",
    kinds=(EntityKind.CLASS,),
    text="How many ancestors a class has along its longest inheritance path.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="0 without bases, else 1 + the largest depth of its bases; a base outside the package has depth 0, as "
    "has Python's object, which as the only base counts as none",
    source="Chidamber and Kemerer, A Metrics Suite for Object Oriented Design, IEEE TSE 20(6), 1994",
    limits="The ancestors of a base in another package are unknown, so the depth is a lower bound. A template "
    "parameter as base counts as a base outside.",
    decimals=1,
)


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float:
    """Return the number of levels above a class."""
    return subject.depth
