"""``list()`` of CMake; cmake-commands(7), *list*."""

from __future__ import annotations

from collections.abc import Callable
from posixpath import basename

from roslens.source.extract.builds.cmake_evaluation import Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_texts import number_in, searched, stripped, substituted
from roslens.source.extract.builds.cmake_value import hole, is_unknown, items_of

Change = Callable[[list[str], list[str]], list[str]]


def _at(items: list[str], value: str) -> int:
    index = number_in(value)
    if not -len(items) <= index < len(items):
        raise IndexError(value)
    return index % len(items)


def _removed_at(items: list[str], rest: list[str]) -> list[str]:
    gone = {_at(items, value) for value in rest}
    return [item for index, item in enumerate(items) if index not in gone]


def _inserted(items: list[str], rest: list[str]) -> list[str]:
    index = number_in(rest[0])
    return [*items[:index], *rest[1:], *items[index:]]


def _filtered(items: list[str], rest: list[str]) -> list[str]:
    keep = {"INCLUDE": True, "EXCLUDE": False}[rest[0]]
    return [item for item in items if (searched(rest[2], item) is not None) is keep]


def _sorted(items: list[str], rest: list[str]) -> list[str]:
    options = dict(zip(rest[::2], rest[1::2], strict=True))
    if not options.keys() <= {"COMPARE", "CASE", "ORDER"} or options.get("COMPARE") == "NATURAL":
        raise ValueError(rest)
    named = basename if options.get("COMPARE") == "FILE_BASENAME" else str
    cased = str.lower if options.get("CASE") == "INSENSITIVE" else str
    return sorted(items, key=lambda item: cased(named(item)), reverse=options.get("ORDER") == "DESCENDING")


def _transformed(items: list[str], rest: list[str]) -> list[str]:
    change, rest = _change(rest)
    chosen = _chosen(items, rest)
    return [change(item) if at in chosen else item for at, item in enumerate(items)]


def _change(rest: list[str]) -> tuple[Callable[[str], str], list[str]]:
    """Return what TRANSFORM does to an item, and the arguments that follow it."""
    action, *more = rest
    if action == "REPLACE":
        return lambda item: substituted(more[0], more[1], item), more[2:]
    if action == "APPEND":
        return lambda item: item + more[0], more[1:]
    if action == "PREPEND":
        return lambda item: more[0] + item, more[1:]
    return {"TOLOWER": str.lower, "TOUPPER": str.upper, "STRIP": stripped}[action], more


def _chosen(items: list[str], rest: list[str]) -> set[int]:
    """Return the places of the items that TRANSFORM changes."""
    if not rest:
        return set(range(len(items)))
    selector, *more = rest
    if selector == "AT":
        return {_at(items, value) for value in more}
    if selector == "FOR":
        first, last = _at(items, more[0]), _at(items, more[1])
        return set(range(first, last + 1, number_in(more[2]) if len(more) > 2 else 1))
    if selector == "REGEX":
        return {at for at, item in enumerate(items) if searched(more[0], item)}
    raise ValueError(selector)


_CHANGES: dict[str, Change] = {
    "REMOVE_ITEM": lambda items, rest: [item for item in items if item not in rest],
    "REMOVE_DUPLICATES": lambda items, _rest: list(dict.fromkeys(items)),
    "REMOVE_AT": _removed_at,
    "INSERT": _inserted,
    "REVERSE": lambda items, _rest: items[::-1],
    "SORT": _sorted,
    "FILTER": _filtered,
    "TRANSFORM": _transformed,
}
_QUERIES: dict[str, Callable[[list[str], list[str]], str]] = {
    "LENGTH": lambda items, _rest: str(len(items)),
    "GET": lambda items, rest: ";".join(items[_at(items, value)] for value in rest),
    "FIND": lambda items, rest: str(items.index(rest[0]) if rest[0] in items else -1),
    "JOIN": lambda items, rest: rest[0].join(items),
    "SUBLIST": lambda items, rest: ";".join(_sublist(items, number_in(rest[0]), number_in(rest[1]))),
}
_KNOWN_ITEMS = frozenset({"REMOVE_DUPLICATES", "REMOVE_ITEM"})
"""What is done to known items of a list of which others are unknown."""


def _sublist(items: list[str], begin: int, length: int) -> list[str]:
    return items[begin:] if length < 0 else items[begin : begin + length]


def _longer(run: Evaluation, name: str, value: str | None, added: list[str], *, first: bool) -> None:
    """Put items at an end of a list. The text stays as it is: what is escaped in it stays so."""
    parts = [value, ";".join(added)] if value else [";".join(added)]
    if added:
        run.variables.set(name, ";".join(parts[::-1] if first else parts))


def _list(run: Evaluation, call: Call) -> None:
    if len(call.arguments) < 2:
        return
    action, name, *rest = call.arguments
    value = run.variables.kept(name)
    run.limits.spend(len(value or "") + 50)
    if action in ("APPEND", "PREPEND"):
        _longer(run, name, value, rest, first=action == "PREPEND")
    elif action in ("POP_BACK", "POP_FRONT"):
        _popped(run, name, value, rest, first=action == "POP_FRONT")
    elif action in _CHANGES:
        _changed(run, call, value)
    elif rest:
        _asked(run, call, value)


def _popped(run: Evaluation, name: str, value: str | None, outs: list[str], *, first: bool) -> None:
    if is_unknown(value or ""):
        for out in (name, *outs):
            run.variables.set(out, hole("list(POP)"))
        return
    items = items_of(value or "", empty=True)
    taken = [(items.pop(0) if first else items.pop()) if items else None for _ in outs or [""]]
    if value is not None:
        run.variables.set(name, ";".join(items))
    for out, item in zip(outs, taken, strict=False):
        run.variables.set(out, item)


def _changed(run: Evaluation, call: Call, value: str | None) -> None:
    action, name, *rest = call.arguments
    out = name
    if action == "TRANSFORM" and "OUTPUT_VARIABLE" in rest[:-1]:
        at = rest.index("OUTPUT_VARIABLE")
        out, rest = rest[at + 1], [*rest[:at], *rest[at + 2 :]]
    if rest[:1] == ["REPLACE"]:
        # What it has matched last depends on items that are gone through within.
        for which in (*range(10), "COUNT"):
            run.variables.set(f"CMAKE_MATCH_{which}", hole("list(TRANSFORM)"))
    if action not in _KNOWN_ITEMS and is_unknown((value or "") + "".join(rest)):
        run.variables.set(out, hole(f"list({action})"))
        return
    try:
        result = _CHANGES[action](items_of(value or "", empty=True), rest)
    except (IndexError, ValueError, LookupError):
        run.variables.set(out, hole(f"list({action})"))
        return
    if result or value is not None or out != name:
        run.variables.set(out, ";".join(result))


def _asked(run: Evaluation, call: Call, value: str | None) -> None:
    action, _name, *rest = call.arguments
    found = hole(f"list({action})")
    if not is_unknown((value or "") + "".join(rest)):
        try:
            found = _QUERIES[action](items_of(value or "", empty=True), rest[:-1])
        except (IndexError, ValueError, LookupError):
            if action == "GET" and value is None:
                found = "NOTFOUND"
    run.variables.set(rest[-1], found)


LIST: dict[str, Handler] = {"list": _list}
