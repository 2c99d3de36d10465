"""Which observers a monitor hears, and what it looks at again when one falls silent or is back."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from roslens.judge.reference.expectation import Presence
from roslens.live.rate.evaluator import Evaluator
from roslens.live.standing.measured import Measured
from roslens.live.standing.standing import Standing
from roslens.live.standing.unheard import Silence, waits_for
from roslens.live.system.connection import Connection
from roslens.live.system.sampled import Sampled
from roslens.live.system.world import World
from roslens.live.window.voice import Voice, Voices


class Hearing:
    """The observers of a monitor, and the silence of each as a verdict about it."""

    def __init__(self, world: World, evaluator: Evaluator, start: float) -> None:
        """Begin at ``start`` without any."""
        self._world = world
        self._evaluator = evaluator
        self._voices = Voices(start)
        self._silences: dict[str, Silence] = {}

    def hear(self, sender: str, looked: float, now: float, *, of_graph: bool) -> Voice:
        """Note that an observer spoke, up to when it has looked, and whether it tells who is there."""
        voice = self._voices.of(sender, now)
        voice.hear(looked)
        voice.of_graph = voice.of_graph or of_graph
        return voice

    def settle(self, now: float) -> list[Standing]:
        """Find out which observers are silent; return those of which that changed."""
        turned = self._voices.settle(now)
        if not turned:
            return []
        self._evaluator.silent = self._voices.silent()
        reported: list[Standing] = []
        for voice in turned:
            silence = self._silences.get(voice.name) or self._silences.setdefault(voice.name, Silence(voice, now))
            silence.follow(now)
            reported.append(silence)
            for one in self._observed(voice):
                self._evaluator.wait(one)
        return reported

    def standing(self) -> Iterator[Standing]:
        """Yield the observers of which nothing is heard."""
        return (one for one in self._silences.values() if one.voice.silent)

    def waits_for(self, presence: Presence) -> Voice | None:
        """Return the silent observer that would have to say whether something is there."""
        return waits_for(presence, self._evaluator.silent) if self._evaluator.silent else None

    def silent_of_graph(self) -> Voice | None:
        """Return a silent observer that tells who is there, and in which state."""
        return next((voice for voice in self._evaluator.silent if voice.of_graph), None)

    def shift(self, now: float) -> None:
        """Begin anew, because the time of the monitor itself broke."""
        self._voices.shift(now)

    def _observed(self, voice: Voice) -> Iterator[Measured]:
        for one in chain(self._world.connections.values(), self._world.sampled.values()):
            if isinstance(one, Connection) and one.reported_by(voice):
                one.wake()
                yield one
            elif isinstance(one, Sampled) and one.voice is voice:
                yield one
        if voice.of_graph:
            yield from self._world.topics.values()
