"""How one constraint about one entity stands, and when that changes: lasting, recovering, hysteresis and grace."""

from __future__ import annotations

from roslens.judge.reference.expectation import Timing
from roslens.model.verdict import State

NEVER = float("inf")
_AT_ITS_BOUND_S = 60.0
"""After so long inside its range without a break a value counts as fine again, however near to the bound."""


class VerdictState:
    """A state that follows what is measured, but not at once.

    A bad value counts after ``timing.lasting``, and then since the fault began; a fine one ends an alarm after
    ``timing.recovering``. Nothing is bad during grace.

    Attributes:
        state: that counts.
        since: when it began.
        time: when it was judged last.
        value: that was judged last.
        due: when the state may change without any news.
    """

    __slots__ = (
        "_bad_since",
        "_began",
        "_fine_since",
        "_inside_since",
        "due",
        "since",
        "state",
        "time",
        "timing",
        "value",
    )

    def __init__(self, timing: Timing, now: float) -> None:
        self.timing = timing
        self.state = State.UNKNOWN
        self.since = self.time = now
        self.value: float | None = None
        self.due = NEVER
        self._bad_since: float | None = None
        self._began = now
        self._fine_since: float | None = None
        self._inside_since: float | None = None

    def step(
        self, now: float, raw: State, value: float | None, *, firm: bool = True, began: float = NEVER, grace: float = 0
    ) -> bool:
        """Take what was measured and return whether the state changed.

        Args:
            now: seconds on the monitor's clock.
            raw: how the value stands to its range.
            value: that was judged.
            firm: whether a fine value is inside by the margin.
            began: when a bad value became bad, if earlier than ``now``.
            grace: until when nothing is bad.
        """
        self.time = now
        self.value = value
        self.due = NEVER
        if raw.bad:
            self._inside_since = None
            return self._bad(now, raw, min(began, now), grace)
        self._bad_since = None
        if raw is State.OK and self.state.bad:
            return self._recover(now, firm=firm)
        self._fine_since = self._inside_since = None
        return self._become(raw, now)

    def forget(self, now: float, state: State) -> bool:
        """Begin anew in ``state``, because time itself broke."""
        self._bad_since = self._fine_since = self._inside_since = None
        self.due = now
        return self._become(state, now)

    def _bad(self, now: float, raw: State, began: float, grace: float) -> bool:
        self._fine_since = None
        if now < grace:
            self._bad_since = None
            self.due = grace
            return self._become(State.UNKNOWN, now)
        if self.state.bad:
            same = self.state is raw or {self.state, raw} == {State.LOW, State.ABSENT}
            return self._become(raw, self.since if same else began)
        if self._bad_since is None:
            self._bad_since, self._began = now, began
        if now - self._bad_since < self.timing.lasting:
            self.due = self._bad_since + self.timing.lasting
            return self.state is State.SUSPENDED and self._become(State.UNKNOWN, now)
        return self._become(raw, self._began)

    def _recover(self, now: float, *, firm: bool) -> bool:
        if self._inside_since is None:
            self._inside_since = now
        if not firm:
            self._fine_since = None
            if now - self._inside_since < _AT_ITS_BOUND_S:
                self.due = self._inside_since + _AT_ITS_BOUND_S
                return False
            return self._become(State.OK, self._inside_since)
        if self._fine_since is None:
            self._fine_since = now
        needed = self.timing.recovering or self.timing.lasting
        if now - self._fine_since < needed:
            self.due = self._fine_since + needed
            return False
        since, self._fine_since = self._fine_since, None
        return self._become(State.OK, since)

    def _become(self, state: State, since: float) -> bool:
        if state is self.state:
            return False
        self.state = state
        self.since = since
        return True
