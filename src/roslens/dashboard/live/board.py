"""What the live page asks of who watches besides the system itself: its references, and notes on alerts."""

from __future__ import annotations

from typing import Protocol

import msgspec


class ConstraintRow(msgspec.Struct, frozen=True, omit_defaults=True):
    """A constraint of the reference, and what it is about.

    Attributes:
        id: of the constraint.
        subject: what it selects, in words.
        expected: what it expects, in words.
        severity: of its being broken.
        where: ``file:line``.
        count: how many entities it judges or would.
        matches: text forms of the ids of the first ones.
        states: how many verdicts are in which state.
        advice: of one that matches nothing, what might have been meant.
    """

    id: str
    subject: str
    expected: str
    severity: str
    where: str
    count: int = 0
    matches: tuple[str, ...] = ()
    states: dict[str, int] = {}
    advice: str = ""


class Twice(msgspec.Struct, frozen=True):
    """A signal of an entity that several constraints judge, each with what it expects."""

    entity: str
    quantity: str
    constraints: tuple[tuple[str, str], ...]


class Proposal(msgspec.Struct, frozen=True):
    """A line that could be added to a reference: its key, the line itself, and what speaks for it."""

    key: str
    line: str
    evidence: str


class References(msgspec.Struct, frozen=True):
    """What is expected, held against what is there.

    Attributes:
        documents: files, in the order in which they were read.
        constraints: those that match nothing first, then those that something deviates from.
        twice: what several constraints judge.
        proposals: of what nothing judges.
        left_out: how many more proposals there would be.
    """

    documents: tuple[str, ...]
    constraints: tuple[ConstraintRow, ...]
    twice: tuple[Twice, ...]
    proposals: tuple[Proposal, ...]
    left_out: int = 0


class Board(Protocol):
    """Every method may be called from any thread, and raises StoreError where a file cannot be read or written."""

    def references(self) -> References | None:
        """Return what is expected; None before the first look at the system."""

    def document(self, accepted: tuple[str, ...]) -> str:
        """Return a reference of the proposals with these keys, as a document."""

    def handle(self, key: str, how: str, seconds: float, by: str) -> str:
        """Note something of an alert (``acknowledge``, ``mute`` for so long, ``undo``); return why not, if not."""
