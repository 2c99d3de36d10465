"""Requirements on packages, and what shows whether they are met."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.model.source import Location


class Met(str, Enum):
    """Whether a requirement is met. What the source cannot show is not known, and never passes for met."""

    MET = "met"
    NOT_MET = "not met"
    NOT_KNOWN = "not known"


class Weight(str, Enum):
    """What a level makes of a requirement."""

    REQUIRED = "required"
    RECOMMENDED = "recommended"
    OPTIONAL = "optional"
    NONE = "none"


class Requirement(msgspec.Struct, frozen=True):
    """A row of REP-2004: its number, what it asks, and what the levels 1 to 4 make of it."""

    number: str
    asks: str
    weights: tuple[Weight, Weight, Weight, Weight]


class Item(msgspec.Struct, frozen=True):
    """A requirement with whether it is met and what shows it; ``where`` are places that do, a few of them."""

    requirement: Requirement
    met: Met
    shown: str
    where: tuple[Location, ...] = ()


class Evidence(msgspec.Struct, frozen=True):
    """What is known of a package against REP-2004. ``claimed`` is the level its declaration names, 0 for none."""

    package: str
    version: str
    claimed: int
    items: tuple[Item, ...]

    def required(self, level: int, met: Met) -> tuple[Item, ...]:
        """Return the items that a level (1 to 4) requires and that are met, not met or not known."""
        return tuple(
            one for one in self.items if one.met is met and one.requirement.weights[level - 1] is Weight.REQUIRED
        )

    @property
    def highest_open(self) -> int:
        """The best level of which nothing required is known not to be met; 5 asks nothing."""
        return next((level for level in (1, 2, 3, 4) if not self.required(level, Met.NOT_MET)), 5)

    @property
    def highest_shown(self) -> int:
        """The best level of which everything required is shown to be met."""
        open_ = (level for level in (1, 2, 3, 4) if not self.required(level, Met.NOT_MET))
        return next((level for level in open_ if not self.required(level, Met.NOT_KNOWN)), 5)
