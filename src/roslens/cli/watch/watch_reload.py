"""References that are read again when their files change, without an end to the watch."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.judge.reading.read_reference import Source, load_reference
from roslens.live.join.note import Note, NoteKind
from roslens.live.window.signals import BY_KEY
from roslens.model.errors import DocumentError

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference
    from roslens.live.join.session import Session, Step

PACE_S = 1.0
"""Files are looked at this often; one that is being written is read when it was the same twice."""

_Stamp = tuple[int, int, int]


class ReferenceFiles:
    """The documents that a watch was started with, and everything they include."""

    def __init__(self, sources: Sequence[Source], *, steady: Callable[[], float]) -> None:
        """Read them; ``steady`` is a clock that never jumps.

        Raises:
            DocumentError: a document is wrong.
        """
        self._sources = sources
        self._steady = steady
        self._touched: set[Path] = set()
        self.reference: Reference = self._load()
        self._next = steady() + PACE_S
        self._stamps = _stamps(self._touched)
        self._contents = _contents(self._touched)
        self._moving = False
        self.broken = False

    def look(self, time: float) -> tuple[Note, ...]:
        """Read the files again if they have changed, and return the notes on that at ``time``."""
        now = self._steady()
        if now < self._next:
            return ()
        self._next = now + PACE_S
        stamps = _stamps(self._touched)
        if stamps != self._stamps:
            self._stamps, self._moving = stamps, True
            return ()
        if not self._moving:
            return ()
        self._moving = False
        contents = _contents(self._touched)
        if contents == self._contents:
            return ()
        changed = sorted(path for path, content in contents.items() if content != self._contents.get(path))
        return (self._read(time, changed),)

    def renew(self, session: Session, step: Step) -> Step:
        """Let a session hold to the files as they are now; return its step with what there is to tell of that."""
        if not (notes := self.look(step.time)):
            return step
        session.monitor.replace_reference(self.reference)
        return msgspec.structs.replace(step, notes=notes)

    def _read(self, time: float, changed: Iterable[Path]) -> Note:
        stamps, contents = _stamps(self._touched), _contents(self._touched)
        try:
            self.reference = self._load()
        except DocumentError as error:
            self.broken = True
            note = Note(time, NoteKind.KEPT, f"the reference as it was before holds on: {error}", error.where)
        else:
            self.broken = False
            count = _constraints(self.reference)
            names = ", ".join(map(str, changed))
            note = Note(time, NoteKind.RELOADED, f"read {names} again: {count} constraint{'' if count == 1 else 's'}")
        # As the files were before they were read: what is written meanwhile is a change of its own.
        self._stamps = {path: stamps.get(path, stamp) for path, stamp in _stamps(self._touched).items()}
        self._contents = {path: contents.get(path, content) for path, content in _contents(self._touched).items()}
        return note

    def _load(self) -> Reference:
        before, self._touched = self._touched, {source for source in self._sources if isinstance(source, Path)}
        try:
            return load_reference(self._sources, BY_KEY, self._touched)
        except DocumentError:
            self._touched |= before
            raise


def _constraints(reference: Reference) -> int:
    parts = (reference.expectations, reference.presences, reference.field_checks, reference.chains)
    return sum(map(len, parts))


def _stamps(paths: Iterable[Path]) -> dict[Path, _Stamp | None]:
    found: dict[Path, _Stamp | None] = {}
    for path in paths:
        try:
            about = path.stat()
        except OSError:
            found[path] = None
        else:
            found[path] = about.st_mtime_ns, about.st_size, about.st_ino
    return found


def _contents(paths: Iterable[Path]) -> dict[Path, bytes]:
    found: dict[Path, bytes] = {}
    for path in paths:
        try:
            found[path] = hashlib.blake2b(read_bounded(path), digest_size=16).digest()
        except OSError:
            found[path] = b""
    return found
