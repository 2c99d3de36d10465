"""Number of children."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="noc",
    title="Number of children",
    unit="classes",
    kinds=(EntityKind.CLASS,),
    text="How many classes derive directly from a class.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of classes of the package that name the class among their bases",
    source="Chidamber and Kemerer, A Metrics Suite for Object Oriented Design, IEEE TSE 20(6), 1994",
    limits="Children in other packages are not seen: an interface that plug-ins of other packages implement has "
    "more. Classes of tests count only for classes of tests.",
    decimals=1,
)


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float:
    """Return the number of direct children of a class."""
    return len(subject.children)
