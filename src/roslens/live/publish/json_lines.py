"""One line of JSON for each change of a verdict and each event, for programs that read along."""

from __future__ import annotations

import msgspec

from roslens.live.note import Note
from roslens.model.failure import Failure
from roslens.model.graph import Event
from roslens.model.verdict import Verdict

SCHEMA = 1


def verdict_line(verdict: Verdict) -> str:
    """Return a verdict as a line without its end."""
    return _line("verdict", {**msgspec.to_builtins(verdict), "entity": str(verdict.entity)})


def cause_line(verdict: Verdict) -> str:
    """Return a bad verdict of which only the cause changed, as a line without its end."""
    return _line("cause", {**msgspec.to_builtins(verdict), "cause": verdict.cause, "entity": str(verdict.entity)})


def note_line(note: Note) -> str:
    """Return what a watch tells of itself as a line without its end."""
    return _line("note", msgspec.to_builtins(note))


def event_line(event: Event) -> str:
    """Return an event of the graph as a line without its end."""
    return _line("event", msgspec.to_builtins(event))


def failure_line(failure: Failure) -> str:
    """Return what could not be done as a line without its end."""
    return _line("failure", msgspec.to_builtins(failure))


def _line(kind: str, content: dict[str, object]) -> str:
    return msgspec.json.encode({"schema": SCHEMA, "is": kind, **content}).decode()
