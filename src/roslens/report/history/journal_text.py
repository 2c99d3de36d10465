"""A journal as text for people: a line for each entry, with what it was done for."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from roslens.model.acting.action_kind import ArgumentType, action_kind
from roslens.store.journals.journal_entry import Entry

_QUIET = ("decision", "action", "because", "place", "fields", "bytes")


def journal_line(entry: Entry, clock: Callable[[float], str]) -> str:
    """Return one entry as a line; ``clock`` writes seconds since the epoch."""
    return f"{clock(entry.time)}  {entry.what:<10}  {_said(entry)}".rstrip()


def _said(entry: Entry) -> str:
    fields = entry.fields
    parts: list[str] = []
    if decision := fields.get("decision"):
        parts.append(f"[{_plain(decision)}]")
    if isinstance(action := fields.get("action"), dict):
        parts.append(action_text(action))
    if entry.what == "decided":
        parts.append(f"about {_plain(fields.get('entity', ''))}")
        if because := because_text(fields.get("because")):
            parts.append(f"because {because}")
        if cause := fields.get("first_cause"):
            parts.append(f"(first cause: {_plain(cause)})")
        return "  ".join(parts)
    return "  ".join((*parts, *_rest(fields, ())))


def rest_text(fields: Mapping[str, Any], leave_out: Sequence[str] = ()) -> str:
    """Return what an entry says beside its decision and action."""
    return ", ".join(_rest(fields, leave_out))


def _rest(fields: Mapping[str, Any], leave_out: Sequence[str]) -> Iterator[str]:
    for key, value in fields.items():
        if key in _QUIET or key in leave_out or value in ("", None, [], {}):
            continue
        shown = f"{value:.3f} s" if key == "duration_s" and isinstance(value, float) else _plain(value)
        yield shown if key in ("result", "text", "gate", "verification", "duration_s") else f"{key}: {shown}"


def action_text(action: Mapping[str, Any]) -> str:
    """Return an action in words: its kind, its target and its arguments."""
    target = action.get("target") or ""
    if isinstance(target, dict):
        target = f"{target.get('kind', '')}:{target.get('name', '')}"
    kind = str(action.get("kind", ""))
    arguments = ", ".join(
        f"{key}: {_argument(kind, key, value)}" for key, value in (action.get("arguments") or {}).items()
    )
    return " ".join(filter(None, (kind, str(target), f"({arguments})" if arguments else "")))


def _argument(kind: str, key: str, value: object) -> str:
    """Return an argument as it is written in a reference: durations have their unit."""
    known = action_kind(kind)
    argument = known.argument(key) if known is not None else None
    if argument is not None and argument.type is ArgumentType.DURATION and isinstance(value, (int, float)):
        return f"{value:g} s"
    return _plain(value)


def because_text(causes: Any) -> str:
    """Return what made a condition true in words, with its values."""
    if not isinstance(causes, (list, tuple)):
        return ""
    shown = []
    for one in causes:
        if isinstance(one, dict):
            value = f" = {one['value']:g}" if isinstance(one.get("value"), (int, float)) else ""
            shown.append(f"{_plain(one.get('statement', ''))}{value}")
    return "; ".join(shown)


def _plain(value: Any) -> str:
    """Return a value on one line, without what a terminal would take as a command."""
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False, sort_keys=True)
    return "".join(one if one.isprintable() else " " for one in text)
