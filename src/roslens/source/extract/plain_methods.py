"""Methods of texts, lists and dictionaries, and of what is unknown, while source is evaluated."""

from __future__ import annotations

from typing import Any

from roslens.source.extract.abstract_value import Unknown, as_text
from roslens.source.extract.text import Hole, Text

SAME = frozenset(
    {"c_str", "get", "lock", "value", "str", "data", "as_string", "get_value", "strip", "encode", "decode",
     "get_parameter_value", "string_value", "as_string_array", "to_string", "copy", "load", "shared_from_this",
     "toStdString"}
)  # fmt: skip
"""Methods that give what they are called on, as far as names are concerned."""


def plain_method(of: Any, name: str, arguments: list[Any]) -> Any:
    """Return the result of a method of a value that is no object of the workspace and none of ROS."""
    if name in SAME and not isinstance(of, list | dict):
        return of
    if isinstance(of, Text):
        return _of_text(of, name, arguments)
    if isinstance(of, list):
        return _of_list(of, name, arguments)
    if isinstance(of, dict):
        return _of_dict(of, name, arguments)
    return of if isinstance(of, Unknown) else Unknown(f"result of {name}()")


def _of_text(of: Text, name: str, arguments: list[Any]) -> Any:
    if name == "format":
        return formatted(of, arguments)
    if name in ("append", "push_back"):
        return Text.of(of, as_text(arguments[0])) if arguments else of
    if name in ("empty", "length", "size") and of.known is not None:
        return not of.known if name == "empty" else len(of.known)
    if name == "join" and arguments and isinstance(arguments[0], list):
        return _joined(of, arguments[0])
    return Unknown(f"{name} of a text")


def _of_list(of: list[Any], name: str, arguments: list[Any]) -> Any:
    if name in ("append", "push_back", "emplace_back", "add") and arguments:
        of.append(arguments[0])
        return None
    if name in ("size", "length", "empty"):
        return not of if name == "empty" else len(of)
    if name in ("front", "back") and of:
        return of[0 if name == "front" else -1]
    return Unknown(f"{name} of a list")


def _of_dict(of: dict[Any, Any], name: str, arguments: list[Any]) -> Any:
    if name == "items":
        return [[key, value] for key, value in of.items()]
    if name in ("get", "at") and arguments:
        return of.get(hashable(arguments[0]), arguments[1] if len(arguments) > 1 else Unknown("an item"))
    if name in ("keys", "values"):
        return list(of) if name == "keys" else list(of.values())
    return Unknown(f"{name}()")


def formatted(pattern: Text, values: list[Any]) -> Text:
    """Return a text with ``%s`` and ``{}`` replaced by values, in order."""
    parts: list[str | Hole | Text] = []
    waiting = list(values)
    for part in pattern.parts:
        if not isinstance(part, str):
            parts.append(part)
            continue
        pieces = part.replace("%d", "%s").replace("{}", "%s").split("%s")
        for place, piece in enumerate(pieces):
            parts.append(piece)
            if place < len(pieces) - 1:
                parts.append(as_text(waiting.pop(0)) if waiting else Text((Hole("a value that is missing"),)))
    return Text.of(*parts)


def hashable(value: Any) -> Any:
    """Return a value as a key of a dictionary."""
    return value if isinstance(value, Text | str | int | float | bool | None) else str(value)


def _joined(separator: Text, values: list[Any]) -> Text:
    parts: list[Text] = []
    for place, one in enumerate(values):
        parts += [separator, as_text(one)] if place else [as_text(one)]
    return Text.of(*parts)
