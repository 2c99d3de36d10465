"""Constraints of a reference that matched nothing, as a watch and a test report them at their end."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.judge.reference.unmatched import unmatched
from roslens.live.join.note import Note, NoteKind
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity

if TYPE_CHECKING:
    from collections.abc import Collection

    from roslens.judge.reference.expectation import Reference
    from roslens.live.join.session import Session

RECORDED = (EntityKind.TOPIC,)
"""What a recording tells of; who sends and receives is in some of them, on which host in none."""
MOST = 20


def about_nothing(session: Session, reference: Reference, time: float, kinds: Collection[EntityKind]) -> list[Note]:
    """Return what of a reference is about nothing that was there while a session watched."""
    return [
        Note(time, NoteKind.UNMATCHED, str(one), one.constraint.details.where)
        for one in unmatched(reference, session.seen(), kinds)
    ]


def errors_about_nothing(session: Session, reference: Reference, kinds: Collection[EntityKind]) -> bool:
    """Return whether a constraint of severity error matched nothing, so that it was never judged."""
    missed = unmatched(reference, session.seen(), kinds)
    return any(one.constraint.details.severity is Severity.ERROR for one in missed)


def kinds_of(session: Session) -> Collection[EntityKind]:
    """Return the kinds of entities that could be seen: without any observer of ROS only hosts."""
    world = session.monitor.world
    return tuple(EntityKind) if world.graph is not None or world.topics else (EntityKind.HOST,)


def lines_of(notes: Collection[Note]) -> list[str]:
    """Return them as lines of text under a heading; nothing of nothing."""
    if not notes:
        return []
    shown = [f"  {note.text}" for note in list(notes)[:MOST]]
    more = [f"  and {len(notes) - MOST} more"] if len(notes) > MOST else []
    number = "1 constraint matches" if len(notes) == 1 else f"{len(notes)} constraints match"
    return [f"{number} nothing that was seen:", *shown, *more]
