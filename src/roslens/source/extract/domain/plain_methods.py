"""Methods of texts, lists and dictionaries, and of what is unknown, while source is evaluated."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Foreign, Table, Unknown, Value, as_text
from roslens.source.extract.domain.guarded import in_place_of, is_counted, unguarded
from roslens.source.extract.domain.kinds import is_whole, known_text
from roslens.source.extract.domain.table_key import hashable
from roslens.source.extract.domain.word_list import length_of
from roslens.source.extract.symbolic.reason import NamePart, OfNode, node_of_reason
from roslens.source.extract.symbolic.text import AreEqual, Hole, Text, said, unknown

SAME = frozenset(
    {"c_str", "get", "lock", "value", "str", "data", "as_string", "get_value", "encode", "decode",
     "get_parameter_value", "string_value", "as_string_array", "to_string", "copy", "load", "shared_from_this",
     "toStdString"}
)  # fmt: skip
"""Methods that give what they are called on, as far as names are concerned."""
_OF_PYTHON = frozenset(
    {"strip", "lstrip", "rstrip", "lower", "upper", "title", "capitalize", "replace", "split", "rsplit", "partition",
     "rpartition", "removeprefix", "removesuffix", "swapcase", "splitlines"}
)  # fmt: skip
_MOST_LENGTH = 10_000
_MOST_ITEMS = 1_000
_EDGES = frozenset({"front", "back"})
_PARTS = frozenset(
    {"find", "rfind", "find_first_of", "find_last_of", "substr", "compare", "startswith", "starts_with", "endswith",
     "ends_with"}
)  # fmt: skip


class LastSlash(Foreign, frozen=True):
    """The place of the last ``/`` in a namespace that is unknown."""

    of: Text


def plain_method(of: Value, name: str, arguments: list[Value]) -> Value:
    """Return the result of a method of a value that is no object of the workspace and none of ROS."""
    match of:
        case list():
            return _of_list(of, name, arguments)
        case dict():
            return _of_dict(of, name, arguments)
        case Unknown():
            return of
        case _ if name in SAME:
            return of
        case Text():
            return _of_text(of, name, arguments)
    return Unknown(f"result of {name}()")


def _of_text(of: Text, name: str, arguments: list[Value]) -> Value:
    if name == "format":
        return formatted(of, arguments)
    if name in ("append", "push_back"):
        return Text.of(of, as_text(arguments[0])) if arguments else of
    if name in _EDGES or name == "empty":
        return _of_edge(of, name)
    if name in _PARTS:
        return _part_of(of, name, arguments)
    if name in ("length", "size") and of.known is not None:
        return len(of.known)
    if name in ("as_bool", "as_int", "as_double") and of.holes:
        return of
    match name, arguments:
        case "join", [list(items), *_]:
            return _joined(of, items)
    if name in _OF_PYTHON:
        return _of_python(of, name, arguments)
    return Unknown(f"{name} of a string")


def _of_python(of: Text, name: str, arguments: list[Value]) -> Value:
    """Return the result of a method of a text of Python that says the same wherever it runs."""
    given = [one if type(one) is int else known_text(one) for one in arguments]
    parameter = next((hole.parameter for hole in of.holes), "")
    longest = max((len(one) for one in map(known_text, arguments) if one is not None), default=1)
    if of.known is None or None in given or len(of.known) * longest > _MOST_LENGTH:
        if name in ("strip", "lstrip", "rstrip") and not arguments:
            return of
        return unknown(said(f"{name} of ", of, most=200), parameter=parameter)
    try:
        found = getattr(of.known, name)(*given)
    except (TypeError, ValueError):
        return Unknown(f"{name} of a string")
    match found:
        case list() | tuple():
            return [Text.of(one) for one in found[:_MOST_ITEMS]]
    return Text.of(found[:_MOST_LENGTH])


def _of_edge(of: Text, name: str) -> Value:
    """Return the first or last sign of a text, or whether it is empty."""
    if name == "empty":
        if len(of.holes) < len(of.parts) or any(map(is_namespace, of.holes)):
            return False
        return Unknown(f"whether {of} is empty", AreEqual(of, Text())) if of.parts else True
    edge = of.head if name in ("front", "begin") else of.tail
    if edge:
        return Text.of(edge[0 if name == "front" else -1])
    if name == "front" and of.parts and is_namespace(of.parts[0]):
        return Text.of("/")
    return Unknown(f"{name} of {of}")


def is_namespace(part: str | Hole) -> bool:
    """Whether a part of a text is the namespace of a node: never empty, beginning with ``/``."""
    match part:
        case Hole(reason=OfNode(what=NamePart.NAMESPACE)):
            return True
    return False


def _part_of_open(of: Text, name: str, text: str) -> Value:
    if name in ("rfind", "find_last_of") and of.holes == of.parts and is_namespace(of.parts[0]) and text == "/":
        return LastSlash(of)
    if name in ("startswith", "starts_with") and of.head and len(of.head) >= len(text):
        return of.head.startswith(text)
    return Unknown(f"{name} of {of}")


def _part_of(of: Text, name: str, arguments: list[Value]) -> Value:
    """Return where something is in a text, a part of it, or whether it begins or ends with something."""
    first = arguments[0] if arguments else None
    text = known_text(first)
    if name == "substr":
        return _cut(of, arguments)
    if text is None or len(arguments) > 1:
        return Unknown(f"{name} of a string")
    if of.known is None:
        return _part_of_open(of, name, text)
    if name in ("startswith", "starts_with", "endswith", "ends_with"):
        return of.known.startswith(text) if name.startswith("starts") else of.known.endswith(text)
    if name == "compare":
        return (of.known > text) - (of.known < text)
    # What is not found is at ``npos``, which is no number that a place has.
    return of.known.rfind(text) if name.startswith(("rfind", "find_last")) else of.known.find(text)


def _cut(of: Text, arguments: list[Value]) -> Value:
    begin, count = (*arguments, None, None)[:2]
    match count:
        case LastSlash() if begin == 0 and count.of == of and not of.head:
            return Text((Hole(OfNode(NamePart.ABOVE, node_of_reason(of.holes[0].reason)), default=""),))
    if not is_whole(begin) or begin < 0 or not (count is None or is_whole(count)) or not all(map(is_whole, arguments)):
        return unknown(said("a part of ", of), parameter=next((hole.parameter for hole in of.holes), ""))
    if of.known is not None:
        return Text.of(of.known[begin:] if count is None or count < 0 else of.known[begin : begin + count])
    if of.head and count is None and begin <= len(of.head):
        return Text.of(of.head[begin:], *of.parts[1:])
    return unknown(said("a part of ", of), parameter=next((hole.parameter for hole in of.holes), ""))


def _of_list(of: list[Value], name: str, arguments: list[Value]) -> Value:
    if name in ("append", "push_back", "emplace_back", "add") and arguments:
        of.append(arguments[0])
        return None
    if name in ("size", "length", "empty"):
        if not is_counted(of):
            return Unknown(f"{name} of a list")
        return not of if name == "empty" else length_of(of)
    if name in ("front", "back") and of and is_counted(of):
        return of[0 if name == "front" else -1]
    if name == "copy" and type(of) is list:
        return list(of)
    return Unknown(f"{name} of a list")


def _are_known(key: Value, of: Table) -> bool:
    """Whether a key and all keys of a table are known, so that it is sure that the table does not have it."""
    return all(map(_is_known_key, (key, *of)))


def _is_known_key(key: Value) -> bool:
    match key:
        case Text():
            return key.known is not None
        case Unknown() | str():
            return False
    return True


def _of_dict(of: Table, name: str, arguments: list[Value]) -> Value:
    if name == "items":
        return [in_place_of(value, [key, unguarded(value)]) for key, value in of.items()]
    if name in ("get", "at") and arguments and hashable(arguments[0]) not in of and not _are_known(arguments[0], of):
        return Unknown("an item of a dictionary")
    if name in ("get", "at") and arguments:
        return of.get(hashable(arguments[0]), arguments[1] if len(arguments) > 1 else Unknown("an item"))
    if name in ("keys", "values"):
        return list(of) if name == "keys" else list(of.values())
    if name == "copy":
        return dict(of)
    return Unknown(f"{name}()")


def formatted(pattern: Text, values: list[Value]) -> Text:
    """Return a text with ``%s`` and ``{}`` replaced by values, in order."""
    parts: list[str | Hole | Text] = []
    waiting = list(values)
    for part in pattern.parts:
        match part:
            case Hole():
                parts.append(part)
                continue
        pieces = part.replace("%d", "%s").replace("{}", "%s").split("%s")
        for place, piece in enumerate(pieces):
            parts.append(piece)
            if place < len(pieces) - 1:
                parts.append(_as_formatted(waiting.pop(0) if waiting else None))
            if any(sign in piece for sign in "{}%"):
                return unknown(said("the format ", pattern, most=200))
    return Text.of(*parts)


def _as_formatted(value: Value) -> Text:
    match value:
        case None:
            return unknown("a value that is missing")
        case bool():
            # It is written ``True`` in Python, ``1`` in C++.
            return unknown("a truth value")
    return as_text(value)


def _joined(separator: Text, values: list[Value]) -> Text:
    parts: list[Text] = []
    if not is_counted(values):
        return unknown("a string built from a list")
    for place, one in enumerate(values):
        parts += [separator, as_text(one)] if place else [as_text(one)]
    return Text.of(*parts)
