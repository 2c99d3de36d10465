"""Notes of a watch: neither a verdict, nor a change of the system, nor a failure of an observer."""

from __future__ import annotations

from enum import Enum

import msgspec


class NoteKind(str, Enum):
    """What a note is about.

    - reloaded: the reference was read again and holds from now on
    - kept: the reference was changed and cannot be used; the old one holds
    - unmatched: a constraint of the reference is about nothing that was seen
    """

    RELOADED = "reloaded"
    KEPT = "kept"
    UNMATCHED = "unmatched"


class Note(msgspec.Struct, frozen=True, omit_defaults=True):
    """A note at ``time``, seconds on the monitor's clock; ``where`` is ``file:line`` of a constraint."""

    time: float
    kind: NoteKind
    text: str
    where: str = ""
