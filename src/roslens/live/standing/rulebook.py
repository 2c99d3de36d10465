"""A reference made ready: which of its constraints are about an entity."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from typing import NamedTuple, TypeVar

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.alternatives import each
from roslens.judge.reference.expectation import End, Expectation, Presence, Reference, Selector, essence
from roslens.judge.reference.pattern_index import PatternIndex
from roslens.live.standing.ready_constraint import ReadyConstraint
from roslens.model.entity import EntityKind

T = TypeVar("T")


class Facts(NamedTuple):
    """What is known of an entity besides its id; an entity may have several hosts, types or publishers.

    ``name`` is what selectors call it, where that is not the name in its id: of a connection its topic. ``copies`` says
    where each one is, where several bear the name. ``by`` are the ends of a topic that are there, where a graph tells.
    """

    hosts: frozenset[str] = frozenset()
    types: frozenset[str] = frozenset()
    publishers: frozenset[str] = frozenset()
    subscriber: str = ""
    name: str = ""
    copies: tuple[str, ...] = ()
    by: frozenset[End] | None = None


NOTHING_KNOWN = Facts()


def find_all(index: PatternIndex[T], kind: EntityKind, name: str, facts: Facts) -> list[T]:
    """Return the constraints on an entity with one of its hosts, one of its types and one of its publishers."""
    ways = product(facts.hosts or ("",), facts.types or ("",), facts.publishers or ("",))
    return [
        item
        for host, type_, publisher in ways
        for item in index.find(
            kind, facts.name or name, host=host, type=type_, publisher=publisher, subscriber=facts.subscriber
        )
    ]


class Rulebook:
    """The constraints of a reference, found by entity.

    Attributes:
        reference: they are from.
        required: constraints about one name without wildcards, by kind and name: it should be there.
        single_presences: presences about one name or pattern each.
        presences: these by the selectors they name; True for that of a condition.
    """

    def __init__(self, reference: Reference, old: Rulebook | None = None) -> None:
        """Read a reference; constraints that ``old`` has too are taken from it, with the details given now.

        Raises:
            ValueError: a pattern of a selector is none.
        """
        self.reference = reference
        known: dict[Expectation, ReadyConstraint] = {essence(one.source): one for one in old.constraints} if old else {}
        self.constraints: list[ReadyConstraint] = [
            known.get(essence(one)) or _ready(one) for one in reference.expectations
        ]
        self._index: PatternIndex[ReadyConstraint] = PatternIndex(
            (one.source.selector, one) for one in self.constraints
        )
        self.required: dict[tuple[EntityKind, str], list[ReadyConstraint]] = {}
        for one in self.constraints:
            if one.literal is not None:
                self.required.setdefault((one.kind, one.literal), []).append(one)
        self.single_presences = tuple(single for one in reference.presences for single in each(one))
        self.presences: PatternIndex[tuple[Presence, bool]] = PatternIndex(_presence_selectors(self.single_presences))
        # Last, since until here something may be wrong, and then everything stays as it is.
        for kept, source in zip(self.constraints, reference.expectations, strict=True):
            kept.source, kept.details = source, source.details

    def about(self, kind: EntityKind, name: str, facts: Facts = NOTHING_KNOWN) -> tuple[ReadyConstraint, ...]:
        """Return the constraints about an entity, in the order of their ids."""
        found = {one.details.id: one for one in find_all(self._index, kind, name, facts)}
        return tuple(found[key] for key in sorted(found))


def _ready(expectation: Expectation) -> ReadyConstraint:
    return ReadyConstraint(expectation, Pattern.parse(expectation.selector.name).literal)


def _presence_selectors(presences: Iterable[Presence]) -> list[tuple[Selector, tuple[Presence, bool]]]:
    """Return the selector of each presence, and that of its condition with True."""
    found = []
    for presence in presences:
        found.append((presence.selector, (presence, False)))
        if presence.condition is not None:
            found.append((presence.condition, (presence, True)))
    return found
