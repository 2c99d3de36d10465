"""One reaction with its conditions over time."""

from __future__ import annotations

from roslens.judge.reading.read_reactions import bound
from roslens.judge.reference.condition_contradiction import statements
from roslens.live.react.evaluation import Chosen, Evaluation
from roslens.live.react.known import Known
from roslens.live.react.truth import Truth
from roslens.model.acting.condition import About, AllOf, AnyOf, Being, Condition, Matching, Stated
from roslens.model.acting.reaction import Because, Reaction
from roslens.model.entity import EntityId


class Plan:
    """A reaction with its conditions over time."""

    def __init__(self, reaction: Reaction, known: Known, chosen: Chosen, start: float) -> None:
        self.reaction = reaction
        self.statements = tuple(statements(reaction.when))
        self.bound = bound(reaction.when)
        self.each: Stated | None = next((one for one in self.statements if one.matching is Matching.EACH), None)
        self.only_suspects = self.each is not None and _needs_fault(reaction.when, self.each)
        self._when = Evaluation(reaction.when, reaction.settled_s, known, chosen, start)
        self._armed = reaction.only_while and Evaluation(reaction.only_while, 0.0, known, chosen, start)
        self._unless = reaction.unless and Evaluation(reaction.unless, 0.0, known, chosen, start, effects=True)

    def truth(self, entity: EntityId | None) -> tuple[Truth, tuple[Because, ...]]:
        """Return whether the reaction is due about an entity, as far as its conditions go, and what shows it."""
        when, shows = self._when.truth(entity)
        armed, also = self._armed.truth(entity) if self._armed else (True, ())
        inhibited = self._unless.truth(entity)[0] if self._unless else False
        if when is True and armed is True and inhibited is False:
            return True, tuple(dict.fromkeys((*shows, *also)))
        return (None if when is not False else False), ()

    def lasts(self, entity: EntityId | None) -> Truth:
        """Return whether what it is about is still so."""
        return self._when.lasts(entity)

    def tracked(self) -> set[EntityId]:
        """Return the entities of which something is remembered over time."""
        return self._when.tracked().union(*(one.tracked() for one in (self._armed, self._unless) if one))

    def forget(self) -> None:
        """Begin all hold times anew."""
        for one in (self._when, self._armed, self._unless):
            if one:
                one.forget()


_FAULTS = frozenset(("low", "high", "absent", "bad", *(one.value for one in Being if one is not Being.THERE)))


def _needs_fault(condition: Condition, each: Stated) -> bool:
    """Whether a condition can only be true of an entity with which something is wrong."""
    if isinstance(condition, Stated):
        faults = condition.about in (About.VERDICT, About.BEING) and _FAULTS.issuperset(condition.states)
        return condition is each and faults and condition.unknown is not True
    if isinstance(condition, AllOf):
        return any(_needs_fault(part, each) for part in condition.parts)
    return isinstance(condition, AnyOf) and all(_needs_fault(part, each) for part in condition.parts)
