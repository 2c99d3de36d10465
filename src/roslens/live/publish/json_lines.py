"""One line of JSON for each change of a verdict and each event, for programs that read along."""

from __future__ import annotations

import msgspec

from roslens.live.join.note import Note
from roslens.model.failure import Failure
from roslens.model.graph import Event
from roslens.model.verdict import Verdict

SCHEMA = 1


def verdict_line(verdict: Verdict, begin: float | None = None, lasted: float | None = None) -> str:
    """Return a verdict as a line without its end.

    Args:
        verdict: that changed.
        begin: of the recording, from which ``at`` and ``since_at`` count; None of what runs now.
        lasted: how long what is fine again had been wrong; None of anything else.
    """
    times = {} if begin is None else {"at": verdict.time - begin, "since_at": verdict.since - begin}
    wrong = {} if lasted is None else {"lasted": lasted}
    return _line("verdict", {**msgspec.to_builtins(verdict), "entity": str(verdict.entity), **times, **wrong})


def cause_line(verdict: Verdict, begin: float | None = None) -> str:
    """Return a bad verdict of which only the cause changed, as a line without its end."""
    times = {} if begin is None else {"at": verdict.time - begin, "since_at": verdict.since - begin}
    content = {**msgspec.to_builtins(verdict), "cause": verdict.cause, "entity": str(verdict.entity)}
    return _line("cause", {**content, **times})


def note_line(note: Note) -> str:
    """Return a note of a watch as a line without its end."""
    return _line("note", msgspec.to_builtins(note))


def event_line(event: Event, begin: float | None = None) -> str:
    """Return an event of the graph as a line without its end."""
    return _line("event", msgspec.to_builtins(event) | ({} if begin is None else {"at": event.time - begin}))


def failure_line(failure: Failure) -> str:
    """Return what could not be done as a line without its end."""
    return _line("failure", msgspec.to_builtins(failure))


def _line(kind: str, content: dict[str, object]) -> str:
    return msgspec.json.encode({"schema": SCHEMA, "is": kind, **content}).decode()
