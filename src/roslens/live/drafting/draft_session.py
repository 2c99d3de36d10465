"""A watch that rates nothing and remembers everything that a reference can be drafted from."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.judge.reference.expectation import Reference
from roslens.live.drafting.draft import Observed
from roslens.live.drafting.draft_bounds import Values
from roslens.live.drafting.draft_presence import Attendance, types_in
from roslens.live.drafting.draft_states import States
from roslens.live.join.session import Session, Step
from roslens.live.window.observer_status import ObserverStatus
from roslens.model.traffic.tally import Tally

LOOK_S = 1.0


class DraftSession(Session):
    """Collects traffic, and once a second what is there.

    Attributes:
        observed: the traffic.
        attendance: who was there.
        values: what was measured beside rates and gaps.
        states: what nodes reported of themselves.
        looked: seconds from the first look at what is there to the last.
    """

    def __init__(self, *, start: float) -> None:
        """Watch from ``start`` on."""
        super().__init__(Reference("nothing"), start=start)
        self.observed = Observed()
        self.attendance = Attendance()
        self.values = Values(LOOK_S)
        self.states = States()
        self.looked = 0.0
        self._first: float | None = None
        self._next = start

    def rate(self, tallies: Iterable[Tally], observer_status: ObserverStatus | None = None) -> None:
        """Keep traffic to draft from."""
        kept = list(tallies)
        self.observed.add_live(kept)
        super().rate(kept, observer_status)

    def look(self, now: float) -> Step:
        """Note what is there, and return what is new."""
        step = super().look(now)
        if self.begun and now >= self._next and self.monitor.world.graph is not None:
            self._next = now + LOOK_S
            self._first = now if self._first is None else self._first
            self.looked = now - self._first
            graph = self.graph()
            self.attendance.look(graph)
            self.states.look(graph)
            self.values.look(now, self.readings(now))
            self.observed.add_types(types_in(graph).items())
        return step
