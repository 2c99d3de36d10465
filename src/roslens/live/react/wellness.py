"""Whether the monitor itself is fit to decide anything: it knows who is there, is in time, and its clock goes on."""

from __future__ import annotations

from roslens.live.join.session import Step

BEGINNING_S = 5.0
"""So long after observers see nothing is decided: what was not seen yet looks like what is gone."""
GROWING_S = 3.0
"""A graph to which no node was added for so long has been found: a participant announces itself every 3 s."""
LONGEST_GROWING_S = 30.0
"""A graph that grows for so long after observers see does so because nodes are started, and is waited for no more."""
LATE_S = 1.0
"""A look that comes so long after the one before was late, unless all of them are as rare."""
_USUAL_TIMES = 5
RECOVERING_S = 3.0
"""So long after something was wrong with the monitor nothing is decided: what waited has to be read, and judged."""
_BACK_S = 0.05


class Wellness:
    """Determines why a monitor is not fit to decide; fed with each step in order."""

    def __init__(self, start: float) -> None:
        """Begin at ``start``, in seconds on the monitor's clock."""
        self._last = start
        self._usual = 0.0
        self._shed = 0
        self._until = float("-inf")
        self._reason = ""
        self._seeing = start
        self._nodes: set[tuple[str, int]] = set()
        self._grew = float("-inf")
        self._found = False

    def look(self, step: Step, now: float) -> str:
        """Return why nothing can be decided at ``now``; empty where it can."""
        gap, self._last = now - self._last, now
        if gap < -_BACK_S:
            self._seeing = min(self._seeing, now)
            self._grew = min(self._grew, now)
            self._ail(now, f"the monitor's clock was set back by {-gap:.1f} s")
        elif gap > max(LATE_S, _USUAL_TIMES * self._usual):
            self._ail(now, f"the monitor looked {gap:.1f} s after the look before")
        elif gap > 0:
            self._usual = gap if not self._usual else 0.9 * self._usual + 0.1 * gap
        if step.shed > self._shed:
            self._ail(now, f"observers dropped {step.shed - self._shed} records")
        self._shed = step.shed
        if not step.begun:
            self._seeing = now
            return "observers do not see yet"
        if not self._found and (why := self._beginning(step, now)):
            return why
        self._found = True
        return self._reason if now < self._until else ""

    def _beginning(self, step: Step, now: float) -> str:
        """Return why what is there has not been found yet; empty where it has.

        A node that ends before it was found is none that anybody can miss: its end would be noticed by nobody.
        """
        found = {(node.name, node.pid) for node in step.graph.nodes} if step.graph is not None else set()
        if found - self._nodes:
            self._grew = now
        self._nodes |= found
        if now - self._seeing < BEGINNING_S:
            return "the monitor has just begun"
        if now - self._grew < GROWING_S and now - self._seeing < LONGEST_GROWING_S:
            return "nodes are still being found"
        return ""

    def _ail(self, now: float, reason: str) -> None:
        self._until, self._reason = now + RECOVERING_S, reason
