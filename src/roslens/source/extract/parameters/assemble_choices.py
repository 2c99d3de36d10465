"""Texts that are one thing or another: which it is where parameters decide it, else both with their conditions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

import msgspec

from roslens.source.extract.facts.node_facts import EndpointFact, Sure
from roslens.source.extract.symbolic.condition import negated
from roslens.source.extract.symbolic.reason import NotSet, is_of_many
from roslens.source.extract.symbolic.text import (
    And,
    AreEqual,
    Choice,
    Condition,
    Conditions,
    Hole,
    IsSet,
    IsTrue,
    NoException,
    Not,
    Or,
    Text,
    Written,
)

MOST = 8
"""So many alternatives of one text are reported; of more it is a text with holes."""
_NO = frozenset({"false", "no", "off", "", "0", "0.0"})


class IsGiven(msgspec.Struct, frozen=True):
    """That a parameter is set, and where: what reads it has that value."""

    parameter: str
    place: str

    def __str__(self) -> str:
        """Write it for people."""
        return f"parameter {self.parameter}, set in {self.place}"


Why = str | IsGiven
"""Why a text is what it is: words, but for what others ask for."""


class Decided(msgspec.Struct, frozen=True):
    """Whether a condition holds, how sure that is, and in words what decides it; ``holds`` None where it is open."""

    holds: bool | None = None
    sure: Sure = Sure.CERTAIN
    how: tuple[Why, ...] = ()


class Alternative(msgspec.Struct, frozen=True):
    """A text without choices, the conditions under which it stands there, and how sure it is that it does."""

    text: Text
    conditions: Conditions = ()
    sure: Sure = Sure.CERTAIN
    how: tuple[Why, ...] = ()


class Filled(msgspec.Struct, frozen=True):
    """A text with values in place of holes, how sure these are, and in words where they come from."""

    text: Text
    sure: Sure = Sure.CERTAIN
    how: tuple[Why, ...] = ()


class Values(Protocol):
    """What the parameters of a node are set to."""

    @property
    def generation(self) -> str:
        """``ros1`` or ``ros2``."""

    def value(self, name: Text) -> object | None:
        """Return what sets a parameter; None where nothing does."""

    def fill(self, text: Text) -> Filled:
        """Return a text with the values of parameters, else their defaults, in place of holes."""


def alternatives(text: Text, values: Values) -> tuple[Alternative, ...]:
    """Return what a text may be: one where the parameters of a node decide it, else each with its conditions."""
    if not any(hole.choice for hole in text.holes):
        return (Alternative(text),)
    found = [one for one in _expanded(text, values) if one.text.parts and not _is_not_set(one.text)]
    if not found or len(found) > MOST or any(_is_of_many(one.text) for one in found):
        return (Alternative(text),)
    if len({one.text for one in found}) == 1 and len(found) > 1:
        return (Alternative(found[0].text, (), doubt(*(one.sure for one in found)), found[0].how),)
    return tuple(found)


def chosen_of(fact: EndpointFact, one: Alternative, name: Text) -> EndpointFact:
    """Return an endpoint with an alternative for its name."""
    if not any(hole.choice for hole in fact.name.holes):
        # An item of a list that is set is as sure as what sets it; what it still lacks says its holes.
        sure = fact.evidence.sure if name == fact.name else Sure.CERTAIN
        return msgspec.structs.replace(fact, name=name, evidence=msgspec.structs.replace(fact.evidence, sure=sure))
    evidence = msgspec.structs.replace(fact.evidence, sure=Sure.CERTAIN, how="written")
    conditions = tuple(dict.fromkeys((*fact.conditions, *one.conditions)))
    return msgspec.structs.replace(fact, name=name, evidence=evidence, conditions=conditions)


def as_decided(fact: EndpointFact, values: Values, *, by_default: bool = False) -> EndpointFact | None:
    """Return an endpoint without the conditions that what is set for its node fulfils; None where it forbids one.

    Args:
        fact: the endpoint.
        values: of the parameters of its node.
        by_default: defaults of parameters that nothing sets decide as well.
    """
    enough = (Sure.CERTAIN, Sure.LIKELY) if by_default else (Sure.CERTAIN,)
    met: set[Condition] = set()
    for condition, asked in fact.asked:
        decided = _decided(asked, values)
        if decided.holds is None or decided.sure not in enough:
            continue
        if not decided.holds:
            return None
        met.add(condition)
    if not met:
        return fact
    return msgspec.structs.replace(fact, conditions=tuple(one for one in fact.conditions if one not in met))


def _is_not_set(text: Text) -> bool:
    match text.only:
        case Hole(reason=NotSet()):
            return True
    return False


def _is_of_many(text: Text) -> bool:
    return any(is_of_many(hole.reason) for hole in text.holes)


def _before(parts: tuple[str | Hole, ...], piece: Text) -> tuple[str | Hole, ...]:
    """Return what stands before a piece of a name."""
    # A name that a private handle is given stays global: roscpp, NodeHandle::resolveName.
    return () if piece.is_global and len(parts) == 1 and str(parts[0]).startswith("~") else parts


def _expanded(text: Text, values: Values) -> Iterator[Alternative]:
    hole = next((one for one in text.holes if one.choice), None)
    if hole is None:
        yield Alternative(text)
        return
    place = text.parts.index(hole)
    choice = hole.choice[0]
    decided = decided_by(choice, values)
    for holds in (True, False) if decided.holds is None else (decided.holds,):
        piece = choice.then if holds else choice.otherwise
        before = _before(text.parts[:place], piece)
        own = () if decided.holds is not None else (choice.condition if holds else negated(choice.condition),)
        for rest in _expanded(Text.of(*before, piece, *text.parts[place + 1 :]), values):
            conditions = tuple(dict.fromkeys((*own, *rest.conditions)))
            yield Alternative(rest.text, conditions, doubt(decided.sure, rest.sure), (*decided.how, *rest.how))


def decided_by(choice: Choice, values: Values) -> Decided:
    """Return whether the condition of a choice holds."""
    return _decided(choice.test[0], values) if choice.test else Decided()


def _decided(test: Condition, values: Values) -> Decided:
    match test:
        case And(of=parts) | Or(of=parts):
            return _joined(parts, values, stops=type(test) is Or)
        case Not(of=one):
            inner = _decided(one, values)
            return inner if inner.holds is None else msgspec.structs.replace(inner, holds=not inner.holds)
        case IsSet(text=text):
            return _set(text, values)
        case IsTrue(text=text):
            filled = values.fill(text)
            known = filled.text.known
            return Decided() if known is None else Decided(known.strip().lower() not in _NO, filled.sure, filled.how)
        case AreEqual(one=one, other=other):
            return _equal(values.fill(one), values.fill(other))
        case Written() | NoException():
            return Decided()


def _equal(one: Filled, other: Filled) -> Decided:
    first, second = one.text.known, other.text.known
    if first is None or second is None:
        return Decided()
    return Decided(_comparable(first) == _comparable(second), doubt(one.sure, other.sure), (*one.how, *other.how))


def _joined(tests: Conditions, values: Values, *, stops: bool) -> Decided:
    inner = [_decided(one, values) for one in tests]
    for one in inner:
        if one.holds is stops:
            return one
    if any(one.holds is None for one in inner):
        return Decided()
    return Decided(not stops, doubt(*(one.sure for one in inner)), tuple(words for one in inner for words in one.how))


def _set(text: Text, values: Values) -> Decided:
    hole = text.holes[0]
    if values.value(Text.of(hole.parameter)) is not None:
        return Decided(holds=True, how=(f"parameter {hole.parameter} is set",))
    if values.generation == "ros2":
        # A parameter that is declared has a value.
        return Decided(holds=True) if hole.default is not None else Decided()
    return Decided(False, Sure.LIKELY, (f"parameter {hole.parameter} is not set",))


def _comparable(text: str) -> str | float:
    try:
        return float(text)
    except ValueError:
        return {"true": "true", "false": "false"}.get(text.lower(), text)


_DOUBT = {Sure.CERTAIN: 0, Sure.LIKELY: 1, Sure.POSSIBLE: 2}


def doubt(*sures: Sure) -> Sure:
    """Return the least sure of several."""
    return max(sures, key=_DOUBT.__getitem__, default=Sure.CERTAIN)
