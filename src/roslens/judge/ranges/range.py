"""Ranges: which values of a quantity are fine."""

from __future__ import annotations

import math
import re

import msgspec

_NUMBER = r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
_BOTH = re.compile(rf"({_NUMBER})\s*\.\.\s*({_NUMBER})\Z")
_ONE = re.compile(rf"(<=|>=)\s*({_NUMBER})\Z")
FORMS = "a range such as `1..15`, `<= 15` or `>= 20`"


class Range(msgspec.Struct, frozen=True):
    """The values between two bounds, both included; None is no bound on that side.

    Raises:
        ValueError: a bound is not a finite number, or the minimum is above the maximum.
    """

    minimum: float | None = None
    maximum: float | None = None

    def __post_init__(self) -> None:
        """Refuse bounds that no value could satisfy."""
        for bound in (self.minimum, self.maximum):
            if bound is not None and not math.isfinite(bound):
                raise ValueError(f"a bound is {bound}, expected a finite number")
        if self.minimum is not None and self.maximum is not None and self.minimum > self.maximum:
            raise ValueError(f"minimum {plain(self.minimum)} is above maximum {plain(self.maximum)}")

    @classmethod
    def parse(cls, text: str) -> Range:
        """Read the text form back: ``1..15``, ``<= 15``, ``>= 20`` or ``any``.

        Raises:
            ValueError: the text is no range.
        """
        stripped = text.strip()
        if stripped == "any":
            return cls()
        if both := _BOTH.match(stripped):
            return cls(float(both[1]), float(both[2]))
        if one := _ONE.match(stripped):
            bound = float(one[2])
            return cls(maximum=bound) if one[1] == "<=" else cls(minimum=bound)
        raise ValueError(f"{text!r} is not a range, expected {FORMS}")

    def __str__(self) -> str:
        """Return ``1..15``, ``<= 15``, ``>= 20`` or ``any``."""
        if self.minimum is None:
            return "any" if self.maximum is None else f"<= {plain(self.maximum)}"
        if self.maximum is None:
            return f">= {plain(self.minimum)}"
        return f"{plain(self.minimum)}..{plain(self.maximum)}"

    def __contains__(self, value: float) -> bool:
        """Whether ``value`` is fine; NaN never is."""
        return (
            not math.isnan(value)
            and (self.minimum is None or value >= self.minimum)
            and (self.maximum is None or value <= self.maximum)
        )

    def covers(self, other: Range) -> bool:
        """Whether every value of ``other`` is in this range too."""
        lower = self.minimum is None or (other.minimum is not None and other.minimum >= self.minimum)
        upper = self.maximum is None or (other.maximum is not None and other.maximum <= self.maximum)
        return lower and upper

    def intersect(self, other: Range) -> Range | None:
        """Return the values that are in both, None where there are none."""
        lows = [bound for bound in (self.minimum, other.minimum) if bound is not None]
        highs = [bound for bound in (self.maximum, other.maximum) if bound is not None]
        low, high = max(lows, default=None), min(highs, default=None)
        return None if low is not None and high is not None and low > high else Range(low, high)

    def overlaps(self, other: Range) -> bool:
        """Whether some value is in both."""
        return self.intersect(other) is not None


def plain(number: float) -> str:
    """Return a number as people write it: ``15``, ``0.25``, never ``15.0``."""
    return str(int(number)) if abs(number) < 1e15 and number == int(number) else repr(float(number))
