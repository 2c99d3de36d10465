"""A constraint: what of which entities has to be in which range; and its words."""

from __future__ import annotations

import msgspec

from roslens.judge.ranges.range import Range, plain
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.weight.consequence import Certainty, Consequence

CONSEQUENCE = Consequence.HARD_TO_MAINTAIN
"""Of all limits on metrics."""
MAX = "max"
MIN = "min"


class Constraint(msgspec.Struct, frozen=True, omit_defaults=True):
    """One constraint of a model: the ``quantity`` of an entity of this ``kind`` is in ``range``.

    Attributes:
        id: identifies it within its model; part of the ids of its rules.
        kind: of the entities it is about.
        quantity: key of the quantity, or of a fold of it (``loc.max``).
        range: the values that are fine, bounds included.
        name: glob on an entity's name (a file's path).
        severity: of its findings.
        tags: of its findings, besides ``metrics`` and the name of the model.
        title: short name; empty for one made from the quantity.
        rationale: why the range is what it is.
        source: where the range is from.
        subject: title of the quantity.
        meaning: of the quantity.
        unit: of the quantity.
        decimals: how many digits of a value a reader needs.
    """

    id: str
    kind: EntityKind
    quantity: str
    range: Range
    name: str = "*"
    severity: Severity = Severity.WARNING
    tags: tuple[str, ...] = ()
    title: str = ""
    rationale: str = ""
    source: str = ""
    subject: str = ""
    meaning: str = ""
    unit: str = ""
    decimals: int = 0

    @property
    def certainty(self) -> Certainty:
        """Of its findings: who sets a limit as a warning or an error says that it is worth acting on."""
        return Certainty.HEURISTIC if self.severity is Severity.NOTE else Certainty.PROVEN

    @property
    def sides(self) -> tuple[str, ...]:
        """The bounds it has: ``max``, ``min``, or both."""
        sides = ((MAX, self.range.maximum), (MIN, self.range.minimum))
        return tuple(side for side, bound in sides if bound is not None)

    def bound(self, side: str) -> float:
        """Return the bound on one of its ``sides``."""
        bound = self.range.maximum if side == MAX else self.range.minimum
        if bound is None:
            raise ValueError(f"{self.id} has no {side}")
        return bound

    def limit_text(self, side: str) -> str:
        """Return ``at most 15`` or ``at least 20 %``."""
        word = "at most" if side == MAX else "at least"
        return f"{word} {plain(self.bound(side))}{self._unit_text()}"

    def value_text(self, value: float, side: str) -> str:
        """Return a value with as many digits as are needed to see that it breaks the bound."""
        bound = self.bound(side)
        for digits in (self.decimals, self.decimals + 1, self.decimals + 3, 9):
            rounded = round(value, digits)
            if (rounded > bound) == (value > bound) and (rounded < bound) == (value < bound):
                return f"{plain(rounded)}{self._unit_text()}"
        return f"{plain(value)}{self._unit_text()}"

    def breach_text(self, value: float, side: str) -> str:
        """Return how far a value breaks a bound, the number first where its title is a plural.

        ``30 calls (limit 10, 3.0 x)``, ``cyclomatic complexity 54 (limit 15, 3.6 x)``,
        ``comment ratio 4 % (at least 20 %)``.
        """
        subject = spoken(self.subject or self.quantity)
        shown = self.value_text(value, side)
        if value >= _LONG and value == int(value):
            shown = f"{value:,.0f}{self._unit_text()}"
        what = f"{shown} {subject}" if verb(subject) == "are" else f"{subject} {shown}"
        bound = self.bound(side)
        if side != MAX:
            return f"{what} ({self.limit_text(side)})"
        times = f", {times_text(value / bound)}" if bound > 0 else ""
        return f"{what} (limit {plain(bound)}{self._unit_text()}{times})"

    def _unit_text(self) -> str:
        return f" {self.unit}" if self.unit in _SHOWN_UNITS else ""


_LONG = 10_000
"""Numbers from here on are grouped by thousands, for readability."""
_SHOWN_UNITS = frozenset({"%", "s", "ms", "us", "Hz", "B", "kB", "MB", "B/s", "kB/s", "MB/s"})


def times_text(ratio: float) -> str:
    """Return a ratio as ``3.6 x``, ``120 x``; one that no reader would count is ``over 1,000 x``."""
    if ratio > 1000:
        return "over 1,000 x"
    # Rounded down to 1.0 it would read as if nothing were broken.
    return f"{ratio:,.0f} x" if ratio >= 100 else f"{max(ratio, 1.01):.{1 if ratio >= 1.05 else 2}f} x"


def spoken(title: str) -> str:
    """Return a title as it reads inside a sentence: its first letter small, unless it is an acronym."""
    return title if title[1:2].isupper() or title[1:2] in {"", "#"} else title[0].lower() + title[1:]


def verb(title: str) -> str:
    """Return ``are`` for a title such as ``Lines of code``, else ``is``."""
    head = title.partition(" of ")[0].partition(" per ")[0].partition(" between ")[0]
    plural = any(word.endswith("s") and not word.endswith(("ss", "is", "us")) for word in head.split())
    return "are" if plural else "is"
