"""Columns of a study from the quantities that roslens measures."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from roslens.judge.quality.quality_model import QualityModel
from roslens.judge.ranges.range import Range
from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity
from roslens.model.study import Column

_SIZES = ("loc", "paper2016.loc", "Cpp LoC")
_COUNTED = frozenset({"rqv", "rcv", "paper2016.rqv"})


def column_of(quantity: Quantity, models: Sequence[QualityModel] = ()) -> Column:
    """Return the column of a quantity; its threshold is that of the first model that has one.

    A bound of functions, classes or files is one of a package's mean too, as in the 2016 study, but not of its sum.
    """
    is_sum = bool(quantity.folds and quantity.folds[0] is Fold.SUM)
    for model in models:
        for constraint in model.constraints:
            if constraint.quantity == quantity.key and (constraint.kind is EntityKind.PACKAGE or not is_sum):
                return _column(quantity, constraint.range, f"{constraint.range} ({model.name})")
    return _column(quantity, Range(), "")


def _column(quantity: Quantity, bounds: Range, threshold: str) -> Column:
    return Column(
        quantity.key,
        quantity.title,
        "" if quantity.unit == "1" else quantity.unit,
        minimum=bounds.minimum,
        maximum=bounds.maximum,
        threshold=threshold,
        decimals=max(quantity.decimals, 0),
        size=quantity.key in _COUNTED or bool(quantity.folds and quantity.folds[0] is Fold.SUM),
    )


def size_among(keys: Collection[str]) -> str:
    """Return the key by which the size of packages is meant, nothing where none of them is there."""
    return next((key for key in _SIZES if key in keys), "")
