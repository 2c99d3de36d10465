"""Differences between two JSON documents, each by the entity and the field in which it is."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

NAMED_BY = ("fingerprint", "id", "name", "title", "path", "text", "endpoint", "proof", "evidence", "reason")
"""Fields that say which of several an element of a list is, the best first."""

NOTHING = "(nothing)"


class Difference(msgspec.Struct, frozen=True):
    """A value that two documents do not have in common.

    Attributes:
        entity: the names on the way to it, joined with `` > ``.
        field: the last of them.
        before: the value of the first document, as JSON, or :data:`NOTHING`.
        after: that of the second.
    """

    entity: str
    field: str
    before: str
    after: str


def differences(before: Any, after: Any, path: tuple[str, ...] = ()) -> Iterator[Difference]:
    """Yield the differences of two documents, in the order of their names."""
    if isinstance(before, Mapping) and isinstance(after, Mapping):
        yield from _of_mappings(before, after, path)
    elif isinstance(before, list) and isinstance(after, list) and _are_entities([*before, *after]):
        first, second = _by_name(before), _by_name(after)
        yield from _of_mappings(first, second, path)
        if list(first) != list(second) and sorted(first) == sorted(second):
            yield _difference(path, "order", list(first), list(second))
    elif _text(before) != _text(after):
        yield _difference(path[:-1], path[-1] if path else "", before, after)


def _of_mappings(before: Mapping[str, Any], after: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[Difference]:
    for key in sorted({*before, *after}):
        if key not in before:
            yield Difference(" > ".join(path), key, NOTHING, _text(after[key]))
        elif key not in after:
            yield Difference(" > ".join(path), key, _text(before[key]), NOTHING)
        else:
            yield from differences(before[key], after[key], (*path, key))


def _difference(path: tuple[str, ...], field: str, before: Any, after: Any) -> Difference:
    return Difference(" > ".join(path), field, _text(before), _text(after))


def _text(value: Any) -> str:
    return msgspec.json.encode(value, order="sorted").decode()


def _are_entities(values: list[Any]) -> bool:
    return bool(values) and all(isinstance(one, Mapping) for one in values)


def _by_name(values: list[Any]) -> dict[str, Any]:
    """Return elements by their names, those of one name by their order too."""
    often: Counter[str] = Counter()
    found = {}
    for one in values:
        name = _name(one)
        often[name] += 1
        found[f"{name} #{often[name]}" if often[name] > 1 else name] = one
    return found


def _name(value: Mapping[str, Any]) -> str:
    for key in NAMED_BY:
        named = value.get(key)
        if isinstance(named, Mapping):
            return _name(named)
        if isinstance(named, str) and named:
            line = value.get("line")
            return f"{named}:{line}" if isinstance(line, int) and key == "path" else named
    return "?"
