"""What is said of what an observer watches, while nothing is heard of the observer."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import Details, Presence, Selector
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.window.voice import Voice
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State

_TOLD = Details("roslens.observers", text="What it observes is unknown until it reports again")
_SAMPLERS = ("agent", "monitor")
_MEANS = {
    "agent": "the agent of {}",
    "monitor": "the monitor's own look at {}",
    "ros1": "the observer of ROS 1 on {}",
    "ros2": "the observer of ROS 2 on {}",
}


def observer_id(voice: Voice) -> EntityId:
    """Return the entity that an observer is."""
    return EntityId(EntityKind.OBSERVER, voice.name)


def observer_words(name: str) -> str:
    """Return ``the agent of robot`` of an observer that calls itself ``robot/agent``."""
    host, _, what = name.rpartition("/")
    return _MEANS[what].format(host) if host and what in _MEANS else f"the observer {name}"


def silence_words(voice: Voice) -> str:
    """Return that nothing is heard of an observer; when that began is in the verdict about the observer."""
    return f"nothing from {observer_words(voice.name)}"


def blame(standing: Standing, voice: Voice) -> None:
    """Note which observer a verdict waits for."""
    standing.window = None
    standing.evidence = silence_words(voice)
    standing.unheard = str(observer_id(voice))


def waits_for(presence: Presence, silent: Iterable[Voice]) -> Voice | None:
    """Return which of these silent observers would have to say whether a presence holds."""
    for selector in (presence.selector, presence.condition):
        for voice in silent if selector is not None else ():
            if selector is not None and _tells_of(voice, selector):
                return voice
    return None


def _tells_of(voice: Voice, selector: Selector) -> bool:
    host, _, what = voice.name.rpartition("/")
    if selector.kind not in (EntityKind.HOST, EntityKind.PROCESS):
        return voice.of_graph
    name = selector.name if selector.kind is EntityKind.HOST else selector.host or "**"
    return what in _SAMPLERS and Pattern.parse(name).matches(host)


class Silence(Standing):
    """That nothing is heard of an observer: unknown, since it was heard last, and the first cause of what is so too."""

    __slots__ = ("voice",)

    def __init__(self, voice: Voice, now: float) -> None:
        super().__init__(observer_id(voice), _TOLD, "presence", "", now)
        self.voice = voice
        self.reported = State.OK

    def follow(self, now: float) -> None:
        """Say how it is at ``now``."""
        self.evidence = silence_words(self.voice) if self.voice.silent else ""
        self.state.forget(self.voice.since, State.UNKNOWN if self.voice.silent else State.OK)
        self.state.since, self.state.time, self.state.due = self.voice.since, now, NEVER
