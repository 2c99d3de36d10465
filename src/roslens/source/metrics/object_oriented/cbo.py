"""Coupling between object classes."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="cbo",
    title="Coupling between classes",
    unit="classes",
    kinds=(EntityKind.CLASS,),
    text="How many other classes a class uses or is used by.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of distinct other classes that are named in the class or in its member functions (bases, fields, "
    "signatures, bodies) or whose static functions are called there, or that do so with it, across the whole package; "
    "bases count",
    source="Chidamber and Kemerer, A Metrics Suite for Object Oriented Design, IEEE TSE 20(6), 1994: two classes are "
    "coupled when one acts on the other, in either direction",
    limits="By name, without types: the class behind `auto`, a typedef or a member of a member is not seen. Classes "
    "outside the package (ros::NodeHandle, QWidget) count as suppliers, those written without scope only if they "
    "look like classes: `QWidget` but not `cloud`, `NodeT`, `Ptr` or `LIMIT`. Fundamental types and the language's "
    "own library (std::, Python's builtins and typing) with its twins in boost do not count. Users in other packages "
    "are not seen. Classes of tests count only for classes of tests.",
    decimals=1,
)


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float:
    """Return the number of classes that a class uses or is used by."""
    return len(subject.suppliers | subject.clients)
