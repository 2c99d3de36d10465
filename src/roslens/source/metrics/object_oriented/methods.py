"""Number of methods (the 2016 paper's WMC)."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.source.metrics.class_model.class_in_package import ClassInPackage
from roslens.source.settings import CountingSettings

QUANTITY = Quantity(
    key="methods",
    title="Methods",
    unit="methods",
    kinds=(EntityKind.CLASS,),
    text="How many member functions a class declares.",
    folds=(Fold.MEAN, Fold.MAX),
    formula="number of member functions declared or defined in the class: constructors, destructor, operators, "
    "static, defaulted and deleted ones and every overload included",
    source="WMC of Chidamber and Kemerer, IEEE TSE 20(6), 1994, with all weights 1, which is what Santos et al., "
    "IROS 2016, report as WMC",
    limits="Inherited, implicit and friend functions do not count. CCCC has the same number for 102 of 121 classes "
    "in headers of kobuki, navigation and yujin_ocs, and fewer where it loses its way in a class.",
    decimals=1,
)


def of_class(subject: ClassInPackage, _counting: CountingSettings) -> float:
    """Return the number of methods of a class."""
    return len(subject.facts.methods)
