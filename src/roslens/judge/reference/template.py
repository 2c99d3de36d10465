"""Templates in the texts of actions: ``{entity} is {state}``; ``{{`` is a brace."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from roslens.plugins.nearest import did_you_mean

FIELDS = {
    "entity": "name of the entity concerned",
    "kind": "kind of that entity: `node`, `topic`…",
    "host": "host on which it is",
    "state": "its state: `absent`, `low`, `gone`…",
    "signal": "key of the signal that is wrong",
    "value": "value that was judged, with its unit",
    "since": "seconds since it has been in this state",
    "cause": "name of the first cause",
    "evidence": "evidence, as text",
    "reaction": "name of the reaction",
    "step": "number of the action in its chain, from 1",
}
"""The fields of templates and their meaning."""

_PART = re.compile(r"\{\{|\}\}|\{([^{}]*)\}|[{}]")


def fields_of(text: str) -> tuple[str, ...]:
    """Return the fields that a text names.

    Raises:
        ValueError: a field is none, or a brace stands alone; the message states what is expected.
    """
    found = []
    for part in _PART.finditer(text):
        if part[0] in {"{{", "}}"}:
            continue
        if part[1] is None:
            raise ValueError(f"{text[:60]!r} has a single brace, expected `{part[0]}{part[0]}` for a brace")
        if part[1] not in FIELDS:
            expected = ", ".join(f"{{{field}}}" for field in FIELDS)
            advice = did_you_mean(part[1], FIELDS)
            raise ValueError(f"unknown field {part[0]!r}, expected one of {expected}{advice and f'. {advice}'}")
        found.append(part[1])
    return tuple(found)


def fields_in(value: Any) -> tuple[str, ...]:
    """Return the fields that all texts in a value of JSON name.

    Raises:
        ValueError: a field is none, or a brace stands alone.
    """
    if isinstance(value, str):
        return fields_of(value)
    parts = value.values() if isinstance(value, Mapping) else value if isinstance(value, list | tuple) else ()
    return tuple(field for part in parts for field in fields_in(part))


def filled(text: str, values: Mapping[str, str]) -> str:
    """Return a text with its fields filled in; what is not known reads ``unknown``."""

    def of(part: re.Match[str]) -> str:
        if part[1] is None:
            return part[0][0]
        return values.get(part[1], "") or "unknown"

    return _PART.sub(of, text)


def filled_in(value: Any, values: Mapping[str, str]) -> Any:
    """Return a value of JSON with the fields of all its texts filled in."""
    if isinstance(value, str):
        return filled(value, values)
    if isinstance(value, Mapping):
        return {key: filled_in(part, values) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [filled_in(part, values) for part in value]
    return value
