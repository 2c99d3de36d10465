"""A reference that is read again while `roslens react` acts by it: taken over whole, or not at all."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

import msgspec

from roslens.live.join.note import Note, NoteKind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from roslens.cli.watch.watch_reload import ReferenceFiles
    from roslens.judge.reference.expectation import Reference
    from roslens.live.join.session import Session, Step
    from roslens.live.react.prepared import Prepared
    from roslens.live.react.reactor import Reactor
    from roslens.model.acting.reaction import Reaction

_READY_WITHIN_S = 30.0


class Preparing(Protocol):
    """Who gets ready for actions before they are due."""

    def prepare_next(self, reactions: Sequence[Reaction]) -> Prepared:
        """Get ready for other reactions beside those that hold."""

    def take_next(self) -> None:
        """Be ready for those in place of what was before."""

    def drop_next(self) -> None:
        """Go on as before."""


class Writing(Protocol):
    """A journal."""

    def add(self, what: str, time: float, **fields: Any) -> object:
        """Append an entry."""


class Renewal:
    """Looks at the files of a reference with each step, and lets what is new hold once all of it could be done."""

    def __init__(
        self, files: ReferenceFiles, session: Session, reactor: Reactor, hands: Preparing, journal: Writing, *,
        steady: Callable[[], float],
    ) -> None:  # fmt: skip
        """Begin with the reference that ``files`` has; ``steady`` is a clock that never jumps."""
        self._files = files
        self._session = session
        self._reactor = reactor
        self._hands = hands
        self._journal = journal
        self._steady = steady
        self._next: tuple[Reference, Prepared, float] | None = None

    def look(self, step: Step) -> Step:
        """Take over changes, and return the step with notes on them."""
        notes: list[Note] = []
        for note in self._files.look(step.time):
            if note.kind is NoteKind.KEPT:
                self._kept(step.time, note.text, note.where)
                notes.append(note)
            else:
                reference = self._files.reference
                prepared = self._hands.prepare_next(reference.reactions)
                self._next = reference, prepared, self._steady() + _READY_WITHIN_S
        if self._next is not None:
            notes += self._decide(step.time, *self._next)
        return msgspec.structs.replace(step, notes=(*step.notes, *notes)) if notes else step

    def _decide(self, time: float, reference: Reference, prepared: Prepared, until: float) -> list[Note]:
        if prepared.waiting() and self._steady() < until:
            return []
        self._next = None
        if problems := prepared.unready():
            place, why = min(problems.items())
            more = f"; and {len(problems) - 1} more" if len(problems) > 1 else ""
            text = f"the reference as it was before holds on: {place}: this action cannot be carried out: {why}{more}"
            self._kept(time, text, place)
            return [Note(time, NoteKind.KEPT, text, place)]
        self._hands.take_next()
        self._session.monitor.replace_reference(reference)
        self._reactor.replace(reference.reactions)
        names = [one.name for one in reference.reactions]
        count = f"{len(names)} reaction{'' if len(names) == 1 else 's'}"
        text = f"the reference was read again and holds from now on, with {count}"
        self._journal.add("reloaded", time, text=text, reactions=names)
        return [Note(time, NoteKind.RELOADED, text)]

    def _kept(self, time: float, text: str, place: str) -> None:
        self._next = None
        self._hands.drop_next()
        self._journal.add("kept", time, text=text, place=place)
