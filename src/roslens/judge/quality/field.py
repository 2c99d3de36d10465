"""The field as a yardstick: how quantities are distributed over ROS packages that many people know.

A field ships with roslens as quantiles, with the commits that it was measured at; `python benchmarks/field.py` makes
one.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

import msgspec

from roslens.model.entity import EntityKind

CURRENT = "ros-2026"
FEWEST = 20
"""Values that a distribution needs to be a yardstick."""


class FieldRepository(msgspec.Struct, frozen=True):
    """A repository that was measured; ``day`` is that of the commit, ``generation`` ros1 or ros2."""

    name: str
    url: str
    commit: str
    day: str
    generation: str


class Distribution(msgspec.Struct, frozen=True, omit_defaults=True):
    """``n`` values of a quantity of a kind of entity, as evenly spaced quantiles from the least to the largest.

    ``group`` is ``""`` for all, or ``role=driver``, ``language=cpp``, ``generation=ros2``.
    """

    quantity: str
    kind: EntityKind
    n: int
    quantiles: tuple[float, ...]
    group: str = ""

    def percentile(self, value: float) -> float:
        """Return how many of a hundred have a smaller value, those with the same one counted half.

        Between two quantiles values are taken to lie evenly; outside of all of them it is 0 or 100.
        """
        steps = len(self.quantiles) - 1
        first, behind = bisect_left(self.quantiles, value), bisect_right(self.quantiles, value)
        if first < behind:
            # Ends of the field are ends of a run of equal values only if there is more of it than one quantile.
            return 100 * (first + behind - 1) / 2 / steps
        if first == 0:
            return 0.0
        if first > steps:
            return 100.0
        low, high = self.quantiles[first - 1], self.quantiles[first]
        return 100 * (first - 1 + (value - low) / (high - low)) / steps

    def value_at(self, percentile: float) -> float:
        """Return the value that this many of a hundred do not exceed."""
        place = percentile / 100 * (len(self.quantiles) - 1)
        low = int(place)
        high = min(low + 1, len(self.quantiles) - 1)
        return self.quantiles[low] + (place - low) * (self.quantiles[high] - self.quantiles[low])


class Field(msgspec.Struct, frozen=True):
    """What was measured, of how many packages, of which repositories; ``day`` is when."""

    name: str
    day: str
    version: str
    packages: int
    repositories: tuple[FieldRepository, ...]
    distributions: tuple[Distribution, ...]

    def find(self, quantity: str, kind: EntityKind, group: str = "") -> Distribution | None:
        """Return a distribution of at least :data:`FEWEST` values, nothing where there is none."""
        wanted = (quantity, kind, group)
        found = (one for one in self.distributions if (one.quantity, one.kind, one.group) == wanted)
        return next((one for one in found if one.n >= FEWEST), None)


@lru_cache(maxsize=16)
def distributions_of(kind: EntityKind, name: str = CURRENT) -> Mapping[str, Distribution]:
    """Return the distributions over all entities of a kind by quantity, for those who look up many."""
    wanted = (one for one in load_field(name).distributions if one.kind is kind and not one.group)
    return {one.quantity: one for one in wanted if one.n >= FEWEST}


@lru_cache(maxsize=4)
def load_field(name: str = CURRENT) -> Field:
    """Return a field that comes with roslens.

    Raises:
        OSError: there is none of this name.
    """
    return msgspec.json.decode((Path(__file__).with_name("fields") / f"{name}.json").read_bytes(), type=Field)
