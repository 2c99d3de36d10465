"""Verdicts on what an observer watches while it does not report."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import Details, Presence, Selector
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.window.observer_status import ObserverStatus
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State

_DETAILS = Details("roslens.observers", text="What it observes is unknown until it reports again")
_SAMPLERS = ("agent", "monitor")
_MEANS = {
    "agent": "the agent of {}",
    "monitor": "the monitor's own look at {}",
    "ros1": "the observer of ROS 1 on {}",
    "ros2": "the observer of ROS 2 on {}",
}


def observer_id(observer_status: ObserverStatus) -> EntityId:
    """Return the entity that an observer is."""
    return EntityId(EntityKind.OBSERVER, observer_status.name)


def observer_words(name: str) -> str:
    """Return ``the agent of robot`` for an observer named ``robot/agent``."""
    host, _, what = name.rpartition("/")
    return _MEANS[what].format(host) if host and what in _MEANS else f"the observer {name}"


def silence_words(observer_status: ObserverStatus) -> str:
    """Return that an observer does not report; since when is in the verdict about the observer."""
    return f"nothing from {observer_words(observer_status.name)}"


def blame(standing: Standing, observer_status: ObserverStatus) -> None:
    """Note which observer a verdict waits for."""
    standing.window = None
    standing.evidence = silence_words(observer_status)
    standing.silent_observer = str(observer_id(observer_status))


def waits_for(presence: Presence, silent: Iterable[ObserverStatus]) -> ObserverStatus | None:
    """Return which of these silent observers would report whether a presence holds."""
    for selector in (presence.selector, presence.condition):
        for observer_status in silent if selector is not None else ():
            if selector is not None and _reports(observer_status, selector):
                return observer_status
    return None


def _reports(observer_status: ObserverStatus, selector: Selector) -> bool:
    host, _, what = observer_status.name.rpartition("/")
    if selector.kind not in (EntityKind.HOST, EntityKind.PROCESS):
        return observer_status.of_graph
    name = selector.name if selector.kind is EntityKind.HOST else selector.host or "**"
    return what in _SAMPLERS and Pattern.parse(name).matches(host)


class Silence(Standing):
    """An observer that does not report: unknown since its last report, the first cause of what it leaves unknown."""

    __slots__ = ("observer_status",)

    def __init__(self, observer_status: ObserverStatus, now: float) -> None:
        super().__init__(observer_id(observer_status), _DETAILS, "presence", "", now)
        self.observer_status = observer_status
        self.reported = State.OK

    def follow(self, now: float) -> None:
        """Update the state at ``now``."""
        self.evidence = silence_words(self.observer_status) if self.observer_status.silent else ""
        self.state.forget(self.observer_status.since, State.UNKNOWN if self.observer_status.silent else State.OK)
        self.state.since, self.state.time, self.state.due = self.observer_status.since, now, NEVER
