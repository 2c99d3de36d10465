"""What a reference asks for by itself: who has to be there, values of fields, ages along paths, states of nodes."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from roslens.live.rate.observer_watch import ObserverWatch
from roslens.live.rate.topic_looks import TopicLooks
from roslens.live.standing.age_chain import AgeChains
from roslens.live.standing.field_check import FieldChecks
from roslens.live.standing.presence import Key, Presences
from roslens.live.standing.rulebook import Rulebook
from roslens.live.standing.standing import Standing
from roslens.live.standing.state_checks import StateChecks
from roslens.live.standing.twins import Twins
from roslens.live.system.copies import place_words
from roslens.live.system.world import World

_CHAINS_S = 0.2
"""Ages along paths are judged so often."""


class Checks:
    """Judges what is expected of a system, whatever was measured of its entities.

    Attributes:
        presences: of what has to exist, or must not.
        fields: of messages.
        states: of managed nodes.
        twins: names that several nodes bear.
    """

    def __init__(self, rules: Rulebook, world: World, now: float) -> None:
        """Begin with what is expected."""
        reference = rules.reference
        self.presences = Presences(rules, now)
        self.fields = FieldChecks(reference.field_checks, now)
        self.states = StateChecks(reference.states, now)
        self.twins = Twins(rules, place_words)
        self._chains = AgeChains(reference.chains, now)
        self._chains_due = now
        self._world = world

    def replace(self, rules: Rulebook, now: float) -> set[Standing]:
        """Judge by another reference; what did not change keeps its state. Return what is judged no more."""
        before, reference = set(self.standing), rules.reference
        self.presences = Presences(rules, now, self.presences)
        self.fields = FieldChecks(reference.field_checks, now, self.fields)
        self.states = StateChecks(reference.states, now, self.states)
        self.twins = Twins(rules, place_words, self.twins)
        self._chains = AgeChains(reference.chains, now, self._chains)
        return before - set(self.standing)

    @property
    def standing(self) -> Iterator[Standing]:
        """Everything that is judged."""
        return chain(self.presences.standing, self.traffic, self.states.standing, self.twins.standing)

    @property
    def traffic(self) -> Iterator[Standing]:
        """What of it is judged by messages."""
        return chain(self.fields.standing, self._chains.standing)

    @property
    def due(self) -> float:
        """When something has to be judged again; infinity where only news can change it."""
        due = min(self.presences.due, self.fields.due, self.states.due, self.twins.due)
        return min(due, self._chains_due) if self._chains.standing else due

    def look_again(self) -> None:
        """Judge who is there again: another observer reports, or is silent."""
        self.presences.look_again()
        self.states.look_again()
        self.twins.look_again()

    def jump(self, now: float) -> None:
        """Judge again what depends on time, which broke."""
        self.presences.look_again()
        self._chains_due = now

    def judge_traffic(self, now: float, began: float) -> list[Standing]:
        """Judge fields of messages and ages along paths; return what changed."""
        changed = self.fields.judge(now, began)
        if self._chains.standing and now >= self._chains_due:
            looks = TopicLooks(self._world, now)
            changed += self._chains.judge(now, looks.value, looks.silence, began)
            self._chains_due = now + _CHAINS_S
        return changed

    def judge_presence(
        self, now: float, began: float, vanished: dict[Key, float], observers: ObserverWatch
    ) -> list[Standing]:
        """Judge who is there and in which state; return what changed."""
        changed = self.states.judge(now, began, observers.silent_of_graph)
        changed += self.twins.judge(now, observers.silent_of_graph)
        return changed + self.presences.judge(now, began, vanished, observers.waits_for)
