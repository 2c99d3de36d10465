"""What happened to parameters, as events; a bounded number of them at a time."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.graph import Change, Event

MOST_EVENTS = 100
"""Of one look; a launch file may set thousands of parameters at once."""


def parameter_events(before: Mapping[str, str], after: Mapping[str, str], time: float) -> list[Event]:
    """Return what happened between two states of parameters, sorted by name.

    Args:
        before: values as text, by full name (``/node/parameter``).
        after: values from now on.
        time: seconds on the observer's clock.
    """
    names = sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))
    events = [_event(name, before.get(name), after.get(name), time) for name in names[:MOST_EVENTS]]
    if len(names) > MOST_EVENTS:
        more = f"{len(names) - MOST_EVENTS:,} more parameters are other than before"
        events.append(Event(time, Change.CHANGED, "parameter:/", more))
    return events


def _event(name: str, old: str | None, new: str | None, time: float) -> Event:
    entity = f"parameter:{name}"
    if old is None:
        return Event(time, Change.APPEARED, entity, f"is {new}")
    if new is None:
        return Event(time, Change.VANISHED, entity, f"was {old}")
    return Event(time, Change.CHANGED, entity, f"{old} is now {new}")
