"""The value of a statement for one entity: true, false or unknown, and its evidence."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.judge.reference.same_value import number_of, same_value
from roslens.live.react.known import Held, Known
from roslens.live.react.truth import Truth, all_of, any_of
from roslens.model.acting.condition import About, Being, Stated
from roslens.model.acting.reaction import Because
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change
from roslens.model.verdict import State, Verdict

_UNJUDGED = (State.UNKNOWN, State.SUSPENDED)
_FINE = frozenset((State.OK.value,))
_AWAY = (Being.GONE, Being.CRASHED)


class Said:
    """The value of a statement for one entity.

    Attributes:
        truth: whether it is so; None where that is unknown.
        shows: what shows that it is.
        settled_at: since when it has been so for the same cause, in seconds on the monitor's clock.
    """

    __slots__ = ("settled_at", "shows", "truth")

    def __init__(self, truth: Truth, shows: tuple[Because, ...] = (), settled_at: float = 0.0) -> None:
        self.truth = truth
        self.shows = shows
        self.settled_at = settled_at


def say(stated: Stated, entity: EntityId, known: Known, *, effects: bool) -> Said:
    """Return the value of a statement for an entity; with ``effects`` faults count that another fault explains."""
    if stated.about is About.VERDICT:
        said = _of_verdicts(stated, entity, known, effects=effects or stated.effects)
    elif stated.about is About.BEING:
        said = _of_being(stated, entity, known, effects=effects or stated.effects)
    else:
        said = _of_text(stated, entity, known)
    if said.truth is None and stated.unknown is not None:
        shows = (Because(str(entity), stated.written, "unknown", known.now),) if stated.unknown else ()
        return Said(stated.unknown, shows, known.now)
    return said


def _of_verdicts(stated: Stated, entity: EntityId, known: Known, *, effects: bool) -> Said:
    states = frozenset(stated.states)
    every = states == _FINE
    truths: list[Truth] = []
    shows: list[Because] = []
    settled: list[float] = []
    for held in known.verdicts(entity):
        verdict = held.verdict
        if stated.quantity and verdict.quantity != stated.quantity:
            continue
        truth = _judged(stated, states, verdict, effects=effects)
        if truth and verdict.state.bad and not effects and _hidden(entity, known):
            truth = None
        truths.append(truth)
        if truth:
            shows.append(_shown(stated, held))
            settled.append(held.settled_at)
    if not truths:
        return Said(None)
    return Said((all_of if every else any_of)(truths), tuple(shows), min(settled, default=known.now))


def _judged(stated: Stated, states: frozenset[str], verdict: Verdict, *, effects: bool) -> Truth:
    state = verdict.state
    if state in _UNJUDGED:
        asked = state.value in states or ("wrong" in states and verdict.wrong)
        return True if asked else None
    if not state.bad:
        return state.value in states
    if not (state.value in states or "bad" in states or "wrong" in states):
        return False
    return verdict.severity.rank >= stated.severity.rank and (effects or not verdict.cause)


def _hidden(entity: EntityId, known: Known) -> bool:
    """Whether what looks bad may be a silence of who observes it, or the end of a whole host."""
    if known.unseen(entity):
        return True
    return entity.kind is EntityKind.NODE and known.presences.went_with_host(entity)


def _shown(stated: Stated, held: Held) -> Because:
    verdict = held.verdict
    return Because(
        str(verdict.entity),
        stated.written,
        verdict.state.value,
        verdict.since,
        verdict.value,
        verdict.quantity,
        verdict.expectation,
        verdict.evidence,
    )


def _of_being(stated: Stated, entity: EntityId, known: Known, *, effects: bool) -> Said:
    presences = known.presences
    seen = presences.there(entity) is not None or presences.gone(entity) is not None
    if not seen or _hidden(entity, known):
        return Said(None)
    found = list(_beings(stated, entity, known))
    truth = any_of(truth for _, truth, _ in found)
    if truth and not effects and any(held.verdict.state.bad and held.verdict.cause for held in known.verdicts(entity)):
        return Said(False)
    shows = tuple(Because(str(entity), stated.written, being.value, since) for being, one, since in found if one)
    return Said(truth, shows, min((one.since for one in shows), default=known.now))


def _beings(stated: Stated, entity: EntityId, known: Known) -> Iterator[tuple[Being, Truth, float]]:
    presences, now = known.presences, known.now
    for being in map(Being, stated.states):
        at: float | None
        if being is Being.THERE:
            at = presences.there(entity)
        elif being is Being.GONE:
            at = presences.gone(entity)
        elif being is Being.CRASHED:
            at = presences.crashed(entity)
        elif being in (Being.RESTARTED, Being.FLAPPING):
            at = presences.befell(entity, Change(being.value), now)
        elif being is Being.MISFIT:
            count = known.misfits(entity.name)
            yield being, None if count is None else count > 0, now
            continue
        else:
            at = known.halted(entity, hung=being is Being.HUNG)
        yield being, at is not None, at if at is not None else now


def _of_text(stated: Stated, entity: EntityId, known: Known) -> Said:
    if stated.about is About.LIFECYCLE:
        text: str | None = known.lifecycle(entity) or None
    else:
        text = known.parameter(entity)
    if text is None:
        return Said(None)
    if stated.states:
        truth = any(same_value(text, state) for state in stated.states)
    else:
        number = number_of(text)
        least, most = stated.least, stated.most
        truth = number is not None and (least is None or number >= least) and (most is None or number <= most)
    shows = (Because(str(entity), stated.written, text, known.now),) if truth else ()
    return Said(truth, shows, float("-inf"))
