"""Methods available in a class."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="mac",
    title="Methods available",
    unit="methods",
    kinds=(EntityKind.CLASS,),
    text="How many methods a class offers to others and to its heirs.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of its methods that are not private",
    source="MAC of the ROS and NASA SATC models: methods that others can call",
    limits="Inherited methods do not count. The 2016 paper took CCCC's weighted methods per class by visibility for "
    "it, which is smaller: CCCC knows the visibility of few methods (equal for 29 of 121 classes in headers of "
    "kobuki, navigation and yujin_ocs). Python: names with two leading underscores are private, `__init__` and its "
    "like are not.",
    decimals=1,
)


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float:
    """Return the number of methods of a class that are not private."""
    return sum(1 for method in subject.facts.methods if method.access != "private")
