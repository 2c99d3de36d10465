"""Conditions that can never be true, as two of their statements exclude each other, or are true whatever happens."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import combinations

from roslens.judge.patterns.pattern import Pattern
from roslens.model.acting.condition import About, AllOf, AnyOf, Being, Condition, Not, Stated
from roslens.model.verdict import State

_FINE = frozenset((State.OK.value,))
_BAD = frozenset(state.value for state in State if state.bad)
_AWAY = frozenset((Being.GONE.value, Being.CRASHED.value))
_THERE = frozenset(
    (Being.THERE.value, Being.RESTARTED.value, Being.FLAPPING.value, Being.STOPPED.value, Being.HUNG.value)
)


def excluding(conditions: Iterable[Condition]) -> tuple[Stated, Stated] | None:
    """Return two statements that cannot both be as conditions that all have to be true ask for it; None for none."""
    asked = [one for condition in conditions for one in _asked(condition, wanted=True)]
    for (one, wanted), (other, others) in combinations(asked, 2):
        if wanted and others and _apart(one, other):
            return one, other
        if wanted is not others and _covers(one, other) and _covers(other, one):
            return one, other
    return None


def always(condition: Condition) -> tuple[Stated, Stated] | None:
    """Return two statements of which one is so whatever happens, so that a condition is always true; None for none."""
    return excluding((Not(condition),))


def statements(condition: Condition) -> Iterator[Stated]:
    """Yield every statement of a condition, those of ``within … of`` too."""
    if isinstance(condition, Stated):
        yield condition
    parts = (condition.part,) if isinstance(condition, Not) else getattr(condition, "parts", ())
    for part in (*parts, *((condition.time.of,) if condition.time.of is not None else ())):
        yield from statements(part)


def _asked(condition: Condition, *, wanted: bool) -> Iterator[tuple[Stated, bool]]:
    """Yield statements about one entity that have to be true, or false, for the condition to be ``wanted``."""
    if not wanted and (condition.time.for_s or condition.time.of is not None):
        # That it has not been so for long does not exclude that it is so now.
        return
    if isinstance(condition, Stated):
        if Pattern.parse(condition.selector.name).literal is not None and condition.unknown is None:
            yield condition, wanted
    elif isinstance(condition, Not):
        yield from _asked(condition.part, wanted=not wanted)
    elif isinstance(condition, AllOf if wanted else AnyOf) or len(getattr(condition, "parts", ())) == 1:
        for part in condition.parts:
            yield from _asked(part, wanted=wanted)


def _covers(one: Stated, other: Stated) -> bool:
    """Whether both make the same statement about the same entities."""
    return (
        one.selector == other.selector
        and one.about is other.about
        and one.quantity == other.quantity
        and _states(one) == _states(other)
        and (one.least, one.most, one.severity, one.effects) == (other.least, other.most, other.severity, other.effects)
    )


def _apart(one: Stated, other: Stated) -> bool:
    if one.selector != other.selector or one.about is not other.about:
        return False
    mine, theirs = _states(one), _states(other)
    if one.about is About.VERDICT:
        return one.quantity == other.quantity and _verdicts_apart(mine, theirs, of_one_signal=bool(one.quantity))
    if one.about is About.BEING:
        return (mine <= _AWAY and theirs <= _THERE) or (mine <= _THERE and theirs <= _AWAY)
    return bool(mine and theirs) and not mine & theirs


def _verdicts_apart(mine: frozenset[str], theirs: frozenset[str], *, of_one_signal: bool) -> bool:
    if of_one_signal:
        return not mine & theirs
    # Without a signal `ok` is about all verdicts, `bad` about any of them.
    return (mine == _FINE and theirs <= _BAD) or (theirs == _FINE and mine <= _BAD)


def _states(stated: Stated) -> frozenset[str]:
    expanded: set[str] = set()
    for state in stated.states:
        expanded |= _BAD if state in ("bad", "wrong") and stated.about is About.VERDICT else {state}
    return frozenset(expanded)
