"""What can be measured: one table of quantities for metrics (static) and signals (live)."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.entity import EntityKind


class Fold(str, Enum):
    """How the values of the parts become a value of the whole."""

    SUM = "sum"
    MEAN = "mean"
    MAX = "max"
    MIN = "min"


class Better(str, Enum):
    """Which way a value improves."""

    LOWER = "lower"
    HIGHER = "higher"
    NEITHER = "neither"


class Quantity(msgspec.Struct, frozen=True, omit_defaults=True):
    """A row of the table of quantities.

    ``kinds`` are the kinds of entity it is measured on. ``folds`` say how it goes up to files and
    packages on which it is not measured: the first fold is stored under ``key`` itself, each
    further one under ``key.fold`` (``cyclomatic_complexity.max``). ``minimum`` and ``maximum``
    bound the values that make sense; a measurement outside them is a failure of its plug-in.
    ``decimals`` is how many digits a reader needs.
    """

    key: str
    title: str
    unit: str
    kinds: tuple[EntityKind, ...]
    text: str
    folds: tuple[Fold, ...] = ()
    better: Better = Better.LOWER
    formula: str = ""
    source: str = ""
    limits: str = ""
    minimum: float | None = 0
    maximum: float | None = None
    decimals: int = 0


class Measurement(msgspec.Struct, frozen=True):
    """A value of a quantity of an entity (by the text form of its id)."""

    entity: str
    quantity: str
    value: float
