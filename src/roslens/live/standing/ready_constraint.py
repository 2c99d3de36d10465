"""An expectation made ready for being judged many times a second."""

from __future__ import annotations

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Details, Expectation, Timing
from roslens.live.window.signals import ENDS, RECEIVED
from roslens.live.window.window import LONGEST_S, PERIODS
from roslens.model.entity import EntityKind
from roslens.model.verdict import State

SHORTEST_S = 1.0
"""No window that roslens sizes is shorter."""
_GAPS = 2
"""How many of the longest gaps that are fine a window holds, where a constraint is about gaps."""
_SILENT = frozenset({"rate", "bandwidth"})


class Bounds:
    """A range with its hysteresis worked out.

    A margin that is wider than the range leaves at least its middle firm: a value that is exact recovers. What is
    counted comes back to the bound itself and does not swing about it, so it has no margin.
    """

    __slots__ = ("_firm_high", "_firm_low", "high", "low")

    def __init__(self, range_: Range, margin: float, *, counted: bool = False) -> None:
        margin = 0.0 if counted else margin
        self.low = range_.minimum if range_.minimum is not None else -float("inf")
        self.high = range_.maximum if range_.maximum is not None else float("inf")
        self._firm_low = self.low + abs(self.low) * margin if range_.minimum is not None else self.low
        self._firm_high = self.high - abs(self.high) * margin if range_.maximum is not None else self.high
        if range_.minimum is not None and range_.maximum is not None:
            middle = (self.low + self.high) / 2
            self._firm_low, self._firm_high = min(self._firm_low, middle), max(self._firm_high, middle)

    def state(self, value: float | None) -> State:
        """Return ok, low, high, or unknown for a value that is missing or not a number."""
        if value is None or value != value:
            return State.UNKNOWN
        if value < self.low:
            return State.LOW
        return State.HIGH if value > self.high else State.OK

    def firm(self, value: float | None, was: State) -> bool:
        """Whether a fine value is far enough from the bound that was broken to count as fine again."""
        if value is None:
            return False
        return value <= self._firm_high if was is State.HIGH else value >= self._firm_low


class ReadyConstraint:
    """What is judged of an entity, and how.

    Attributes:
        source: the expectation.
        details: what goes with it.
        key: of the signal.
        bounds: of fine values.
        timing: of it.
        written: the range, as people read it.
        percentile: 0 for the value of the window itself.
        period: longest time between messages that is fine, 0 where the constraint says nothing of it.
        window: seconds of it that the constraint asks for; 0 for what is usual of the entity.
        silence: whether a value of 0 means that there was silence where something should be.
        literal: the only name it is about, where it has no wildcards.
    """

    __slots__ = (
        "bounds",
        "details",
        "key",
        "literal",
        "percentile",
        "period",
        "silence",
        "source",
        "timing",
        "window",
        "written",
    )

    def __init__(self, source: Expectation, literal: str | None) -> None:
        self.source = source
        self.details: Details = source.details
        self.key = source.quantity
        self.timing: Timing = source.details.timing
        self.bounds = Bounds(source.range, self.timing.margin, counted=self.key in ENDS)
        self.written = source.written or str(source.range)
        self.percentile = source.percentile
        self.literal = literal
        low, high = source.range.minimum, source.range.maximum
        self.period = 0.0
        if self.key in ("rate", RECEIVED) and low is not None and low > 0:
            self.period = 1 / low
        elif self.key == "period" and high is not None and high > 0:
            self.period = high
        self.window = self.timing.window
        if not self.window and self.key == "largest_gap" and high is not None and high > 0 and not self.percentile:
            # It need only hold the gap, or gaps shortly after one another become one alarm.
            self.window = min(_GAPS * high, LONGEST_S)
        self.silence = self.key in _SILENT and low is not None and low > 0

    @property
    def kind(self) -> EntityKind:
        """Of the entities it is about."""
        return self.source.selector.kind


def window_length(period: float) -> float:
    """Return the seconds of a window for traffic of an expected period; 0, to be found, where none is expected."""
    return max(SHORTEST_S, PERIODS * period) if period else 0.0
