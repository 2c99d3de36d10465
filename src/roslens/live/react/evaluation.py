"""Whether a condition is true of a system, now and for long enough: a tree evaluated look by look."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.pattern_index import CompiledSelector
from roslens.live.react.known import Known
from roslens.live.react.statement import Said, say
from roslens.live.react.truth import Truth, all_of, any_of, at_least, negated
from roslens.model.acting.condition import (
    About,
    AllOf,
    AnyOf,
    AtLeast,
    Being,
    Condition,
    Matching,
    Not,
    OverTime,
    Stated,
)
from roslens.model.acting.reaction import Because
from roslens.model.entity import EntityId, EntityKind
from roslens.model.selector import Selector
from roslens.model.verdict import State

_CLOSE_S = 1e-6
"""Times of looks are sums of floating-point numbers."""

_OTHER, _BEGAN, _OTHER_BEGAN, _SETTLING = -1, -2, -3, -4
"""Places below a condition that no part of it has."""
LONG_GONE_S = 60.0
"""So long after it ended nothing will be known any more of what `each` is about: it was not merely restarted."""
_BAD = frozenset(state.value for state in State if state.bad)
_FAULTS = frozenset(one.value for one in Being if one is not Being.THERE)

_Path = tuple[int, ...]
_Key = tuple[_Path, EntityId | None, EntityId | None]


class Chosen:
    """The entities that selectors choose, found again when there are new ones."""

    def __init__(self, known: Known) -> None:
        self._known = known
        self._found: dict[Selector, tuple[int, tuple[EntityId, ...]]] = {}
        self._compiled: dict[Selector, CompiledSelector] = {}

    def of(self, selector: Selector) -> tuple[EntityId, ...]:
        """Return the known entities that a selector chooses, sorted; of a name alone that one, known or not."""
        literal = Pattern.parse(selector.name).literal
        plain = literal is not None and Selector(selector.kind, selector.name) == selector
        if literal is not None and plain and selector.kind is not EntityKind.CONNECTION:
            return (EntityId(selector.kind, literal),)
        cached = self._found.get(selector)
        if cached is None or cached[0] != self._known.generation:
            found = {one for one in self._known.entities(selector.kind) if self._matches(selector, one)}
            cached = self._found[selector] = (self._known.generation, tuple(sorted(found)))
        return cached[1]

    def _matches(self, selector: Selector, entity: EntityId) -> bool:
        compiled = self._compiled.get(selector) or self._compiled.setdefault(selector, CompiledSelector(selector))
        traits = self._known.traits(entity)
        return any(
            compiled.matches(traits.name or entity.name, (host, type_, publisher, traits.subscriber))
            for host in traits.hosts or ("",)
            for type_ in traits.types or ("",)
            for publisher in traits.publishers or ("",)
        )


class Evaluation:
    """One condition over time.

    Below a ``not``, and everywhere with ``effects``, faults count that another fault explains: what is not to be the
    case must not be the case for whatever reason.
    """

    def __init__(
        self,
        condition: Condition,
        settled_s: float,
        known: Known,
        chosen: Chosen,
        start: float,
        *,
        effects: bool = False,
    ) -> None:
        """Evaluate from ``start`` on; ``settled_s`` is for how long first causes have to have been the same."""
        self._effects = effects
        self._condition = condition
        self._settled_s = settled_s
        self._known = known
        self._chosen = chosen
        self._start = start
        self._since: dict[_Key, float] = {}
        self._fresh = start

    def truth(self, bound: EntityId | None) -> tuple[Truth, tuple[Because, ...]]:
        """Return whether it is true now, with hold times, and what shows it; ``bound`` is what ``each`` is about."""
        shows: list[Because] = []
        truth = self._of(self._condition, (), bound, shows, self._effects)
        return truth, tuple(sorted(set(shows), key=lambda one: (one.entity, one.expectation, one.statement, one.state)))

    def lasts(self, bound: EntityId | None) -> Truth:
        """Return whether what it is about is still so: without hold times, and whatever is the cause.

        What a pattern chose, and what ended or was never judged, keeps nothing unknown: nobody will ever say of it that
        it is not so.
        """
        return self._plainly(self._condition, bound)

    def tracked(self) -> set[EntityId]:
        """Return the bound entities of which something is remembered over time."""
        return {bound for _, bound, _ in self._since if bound is not None}

    def forget(self, bound: EntityId | None = None) -> None:
        """Begin all hold times anew; with an entity those of what is bound to it."""
        self._since = {} if bound is None else {key: at for key, at in self._since.items() if key[1] != bound}
        self._fresh = self._known.now

    def _of(
        self, condition: Condition, path: _Path, bound: EntityId | None, shows: list[Because], effects: bool
    ) -> Truth:
        mine: list[Because] = []
        if isinstance(condition, Stated):
            truth = self._stated(condition, path, bound, mine, effects)
        else:
            whatever = effects or isinstance(condition, Not)
            parts = [self._of(part, (*path, at), bound, mine, whatever) for at, part in enumerate(_parts(condition))]
            truth = _joined(condition, parts)
            if condition.time.for_s:
                truth = self._held(truth, (path, bound, None), condition.time.for_s)
        truth = self._in_time(condition.time, truth, path, bound, effects)
        # What is below a `not` shows nothing of what is so.
        if truth and not isinstance(condition, Not):
            shows += mine
        return truth

    def _stated(
        self, stated: Stated, path: _Path, bound: EntityId | None, shows: list[Because], effects: bool
    ) -> Truth:
        entities = self._entities(stated, bound)
        truths = []
        for entity in entities:
            said = say(stated, entity, self._known, effects=effects)
            truth = self._settled(stated, said, path, bound, entity)
            if stated.time.for_s:
                began = max(_silent_since(said), self._fresh)
                truth = self._held(said.truth, (path, bound, entity), stated.time.for_s, began) and truth
            if truth:
                shows += said.shows
            truths.append(truth)
        if not truths:
            return stated.unknown
        return (all_of if stated.matching is Matching.ALL else any_of)(truths)

    def _settled(self, stated: Stated, said: Said, path: _Path, bound: EntityId | None, entity: EntityId) -> Truth:
        """Return what is said, but unknown where a fault has not been so for long enough, for the same cause."""
        if stated.about is About.VERDICT:
            lasting = self._known.now - said.settled_at >= self._settled_s - _CLOSE_S
            return said.truth if lasting or not any(one.state in _BAD for one in said.shows) else None
        if stated.about is About.BEING and _FAULTS.intersection(stated.states):
            lasting = self._held(said.truth, ((*path, _SETTLING), bound, entity), self._settled_s) is True
            return said.truth if lasting or said.truth is not True else None
        return said.truth

    def _entities(self, stated: Stated, bound: EntityId | None) -> tuple[EntityId, ...]:
        if stated.matching is Matching.EACH:
            return (bound,) if bound is not None else ()
        return self._chosen.of(stated.selector)

    def _held(self, truth: Truth, key: _Key, for_s: float, began: float = float("inf")) -> Truth:
        """Return whether it has been true for so long: since it was reported, or ``began`` where that is before."""
        if truth is not True:
            self._since.pop(key, None)
            return truth
        return self._known.now - self._since.setdefault(key, min(began, self._known.now)) >= for_s - _CLOSE_S

    def _in_time(self, time: OverTime, truth: Truth, path: _Path, bound: EntityId | None, effects: bool) -> Truth:
        if time.after_start_s and self._known.now - self._start < time.after_start_s - _CLOSE_S:
            return None
        if time.of is None:
            return truth
        other = self._of(time.of, (*path, _OTHER), bound, [], effects)
        mine = self._began((*path, _BEGAN), bound, truth)
        theirs = self._began((*path, _OTHER_BEGAN), bound, other)
        if truth is not True or mine is None:
            return truth
        if theirs is None or abs(theirs - mine) > time.within_s + _CLOSE_S:
            return None if other is None else False
        return True

    def _began(self, path: _Path, bound: EntityId | None, truth: Truth) -> float | None:
        """Return when something became true last; None where it never did."""
        now, latest = (path, bound, None), ((*path, 0), bound, None)
        if truth is not True:
            self._since.pop(now, None)
        elif now not in self._since:
            self._since[now] = self._since[latest] = self._known.now
        return self._since.get(latest)

    def _plainly(self, condition: Condition, bound: EntityId | None) -> Truth:
        if not isinstance(condition, Stated):
            return _joined(condition, [self._plainly(part, bound) for part in _parts(condition)])
        entities = self._entities(condition, bound)
        truths = [say(condition, one, self._known, effects=True).truth for one in entities]
        if condition.matching is Matching.ANY and len(entities) > 1:
            truths = [
                False if truth is None and self._is_over(condition, one) else truth
                for one, truth in zip(entities, truths, strict=True)
            ]
        if condition.matching is Matching.EACH and truths == [None] and self._is_gone_for_long(entities[0]):
            return False
        if not truths:
            return condition.unknown
        return (all_of if condition.matching is Matching.ALL else any_of)(truths)

    def _is_over(self, stated: Stated, entity: EntityId) -> bool:
        """Whether nothing of what is stated will be known of an entity any more, or never was.

        That a host is gone says only that nobody samples it: what was wrong with it may still be.
        """
        if stated.about is About.VERDICT and not any(
            stated.quantity in ("", held.verdict.quantity) for held in self._known.verdicts(entity)
        ):
            return True
        return entity.kind is not EntityKind.HOST and self._known.presences.gone(entity) is not None

    def _is_gone_for_long(self, entity: EntityId) -> bool:
        since = self._known.presences.gone(entity)
        return entity.kind is not EntityKind.HOST and since is not None and self._known.now - since > LONG_GONE_S


def _silent_since(said: Said) -> float:
    """Return since when nothing has come, where that is what is said; infinity of anything else.

    Silence is reported late, once nobody is left who might have heard something. That it has lasted is a fact:
    nothing arrived since then, so that hold times count from there. A value over its bound says nothing of before.
    """
    verdicts = [one for one in said.shows if one.quantity]
    silent = bool(verdicts) and all(one.state == State.ABSENT.value for one in verdicts)
    return max(one.since for one in verdicts) if silent else float("inf")


def _parts(condition: AllOf | AnyOf | AtLeast | Not) -> Iterator[Condition]:
    yield from (condition.part,) if isinstance(condition, Not) else condition.parts


def _joined(condition: AllOf | AnyOf | AtLeast | Not, parts: list[Truth]) -> Truth:
    if isinstance(condition, Not):
        return negated(parts[0])
    if isinstance(condition, AtLeast):
        return at_least(condition.count, parts)
    return (all_of if isinstance(condition, AllOf) else any_of)(parts)
