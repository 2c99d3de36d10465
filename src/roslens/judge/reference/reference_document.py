"""A reference document as read, before it is merged with others."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from roslens.judge.reference.expectation import AgeChain, Expectation, FieldCheck, Presence, StateCheck, Timing
from roslens.model.acting.reaction import Reaction
from roslens.model.finding import Severity
from roslens.model.quantity import Quantity

ReferenceConstraint = Expectation | Presence | FieldCheck | AgeChain | StateCheck


class Defaults(msgspec.Struct, frozen=True):
    """The defaults of constraints."""

    severity: Severity = Severity.WARNING
    group: str = ""
    timing: Timing = Timing()


class Scope(msgspec.Struct, frozen=True):
    """What a constraint takes from the document in which it stands.

    Attributes:
        document: name of the document.
        known: the signals, by key.
        namespace: put before relative names; empty for none.
        prefix: put before ids, where the document was included into a namespace.
        defaults: of its constraints.
    """

    document: str
    known: Mapping[str, Quantity]
    namespace: str = ""
    prefix: str = ""
    defaults: Defaults = Defaults()


class Declared(msgspec.Struct, frozen=True):
    """A constraint with what merging asks for.

    Attributes:
        constraint: what is expected.
        name: what the document calls it, or what it is called by default; constraints on several signals share it.
        aspect: what of it this constraint is about; its id is ``<document>.<name>.<aspect>``.
        place: ``file:line:column``.
        given: whether the document itself names it.
        override: whether it replaces another.
        void: whether it expects nothing, so that overriding with it takes the other away.
    """

    constraint: ReferenceConstraint
    name: str
    aspect: str
    place: str
    given: bool = False
    override: bool = False
    void: bool = False


class DeclaredReaction(msgspec.Struct, frozen=True):
    """A reaction with what merging asks for: what its document calls it, and whether it replaces another."""

    reaction: Reaction
    name: str
    override: bool = False


class ReferenceDocument(msgspec.Struct, frozen=True):
    """One document: its own constraints, in the order in which they stand; included ones are documents of their own.

    ``path`` is what messages call the file.
    """

    name: str
    title: str
    path: str
    declared: tuple[Declared, ...]
    reactions: tuple[DeclaredReaction, ...] = ()
