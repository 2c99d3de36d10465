"""The values of a package, file, class or function by name: which quantity, how folded, how it is written."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from roslens.judge.quality.fold import folded_keys
from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity


class Measured(msgspec.Struct, frozen=True):
    """What a key among an entity's values stands for; ``fold`` is empty where it was measured on the entity itself."""

    key: str
    quantity: Quantity
    fold: str = ""

    @property
    def title(self) -> str:
        """The quantity's title, with how it was folded unless it is a plain sum."""
        return f"{self.quantity.title} ({self.fold})" if self.fold and self.fold != "sum" else self.quantity.title

    @property
    def decimals(self) -> int:
        """Digits after the point that a reader needs: a mean needs one at least."""
        return max(1, self.quantity.decimals) if self.fold == "mean" else self.quantity.decimals

    @property
    def better(self) -> Better:
        """Which way it improves."""
        return self.quantity.better


def measured_on(quantities: Mapping[str, Quantity], kind: EntityKind) -> dict[str, Measured]:
    """Return key -> meaning of every value that an entity of ``kind`` may have."""
    found: dict[str, Measured] = {}
    for quantity in quantities.values():
        if kind in quantity.kinds:
            found[quantity.key] = Measured(quantity.key, quantity)
            continue
        for key, fold in zip(folded_keys(quantity), quantity.folds, strict=True):
            found[key] = Measured(key, quantity, fold.value)
    return found
