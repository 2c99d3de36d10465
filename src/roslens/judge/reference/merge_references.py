"""Merges reference documents: all their constraints hold, unless one replaces another in so many words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

import msgspec

from roslens.judge.reference.contradiction import Contradiction, contradictions
from roslens.judge.reference.expectation import AgeChain, Expectation, FieldCheck, Presence, Reference, StateCheck
from roslens.judge.reference.merge_reactions import merge_reactions
from roslens.judge.reference.reference_document import Declared, ReferenceConstraint, ReferenceDocument
from roslens.model.errors import DocumentError
from roslens.plugins.nearest import did_you_mean

Kind = TypeVar("Kind", Expectation, Presence, FieldCheck, AgeChain, StateCheck)


class Merged(msgspec.Struct, frozen=True):
    """What documents expect together, and how that came about.

    Attributes:
        reference: what holds.
        contradictions: what of it cannot hold together.
        standing: the constraints that hold, in the order of the documents; one that overrides stands for the other.
        replaced: constraints that do not hold any more, each with what took its place.
    """

    reference: Reference
    contradictions: tuple[Contradiction, ...]
    standing: tuple[Declared, ...]
    replaced: tuple[tuple[Declared, Declared], ...]


def merge_references(documents: Sequence[ReferenceDocument]) -> Merged:
    """Merge documents, later ones taking precedence where they override.

    Raises:
        DocumentError: a constraint has the id of another without overriding it, or overrides none.
    """
    kept: dict[str, Declared] = {}
    replaced: list[tuple[Declared, Declared]] = []
    for document in documents:
        for one in document.declared:
            if one.override:
                identity = _overridden(kept, one, document)
                replaced.append((kept[identity], one))
                kept[identity] = _renamed(one, identity)
            elif (identity := one.constraint.details.id) not in kept:
                kept[identity] = one
            elif one.constraint != kept[identity].constraint:
                # A document in two namespaces repeats its constraints on hosts; anything else is an accident.
                raise DocumentError(
                    f"a second constraint with id {identity!r}",
                    where=one.place,
                    expected=f"one (the first is at {kept[identity].place})",
                    advice="Add `override: true` to replace the first, or give it another `id`",
                )
    standing = tuple(one for one in kept.values() if not one.void)
    reference = Reference(
        name="+".join(dict.fromkeys(document.name for document in documents)),
        title=documents[-1].title if documents else "",
        documents=tuple(dict.fromkeys(document.path for document in documents)),
        expectations=_sorted(standing, Expectation),
        presences=_sorted(standing, Presence),
        field_checks=_sorted(standing, FieldCheck),
        chains=_sorted(standing, AgeChain),
        states=_sorted(standing, StateCheck),
        reactions=merge_reactions(documents),
    )
    return Merged(reference, tuple(contradictions(standing)), standing, tuple(replaced))


def constraints_of(reference: Reference) -> tuple[ReferenceConstraint, ...]:
    """Return every constraint of a reference, sorted by id."""
    everything: list[ReferenceConstraint] = [
        *reference.expectations,
        *reference.presences,
        *reference.field_checks,
        *reference.chains,
        *reference.states,
    ]
    return tuple(sorted(everything, key=lambda constraint: constraint.details.id))


def _sorted(declared: Sequence[Declared], kind: type[Kind]) -> tuple[Kind, ...]:
    found = [one.constraint for one in declared if isinstance(one.constraint, kind)]
    return tuple(sorted(found, key=lambda constraint: constraint.details.id))


def _renamed(one: Declared, identity: str) -> Declared:
    """Return a constraint with the id of the one it replaces, as others may refer to that."""
    details = msgspec.structs.replace(one.constraint.details, id=identity)
    return msgspec.structs.replace(one, constraint=msgspec.structs.replace(one.constraint, details=details))


def _overridden(kept: dict[str, Declared], one: Declared, document: ReferenceDocument) -> str:
    """Return the id of the constraint that another replaces.

    Raises:
        DocumentError: there is none, or there are several.
    """
    own = {declared.constraint.details.id for declared in document.declared if not declared.override}
    words = f"{one.name}.{one.aspect}"
    targets = [
        identity
        for identity in kept
        if identity not in own and (identity == words or identity.partition(".")[2] == words)
    ]
    if len(targets) == 1:
        return targets[0]
    if targets:
        ids = " or ".join(f"`{identity.removesuffix(f'.{one.aspect}')}`" for identity in targets)
        raise DocumentError(
            f"id {one.name!r} of several constraints to override", where=one.place, expected=f"id {ids}"
        )
    names = {name.removesuffix(f".{one.aspect}") for full in kept for name in (full, full.partition(".")[2])}
    raise DocumentError(
        f"nothing to override: no constraint {words!r} in an earlier document",
        where=one.place,
        expected="the id of a constraint that is included or given before",
        advice=did_you_mean(one.name, names) or "`roslens reference check` lists the ids",
    )
