"""``list()`` and ``string()`` of CMake."""

from __future__ import annotations

import re
from collections.abc import Callable

from roslens.source.extract.cmake_evaluation import MOST_LENGTH, Call, Evaluation, Handler
from roslens.source.extract.cmake_value import expression_of, hole, is_unknown, items_of, searchable

Change = Callable[[list[str], list[str]], list[str]]


def _number(value: str) -> int:
    if not re.fullmatch(r"[+-]?\d{1,9}", value, re.ASCII):
        raise ValueError(value)
    return int(value)


def _at(items: list[str], value: str) -> int:
    index = _number(value)
    if not -len(items) <= index < len(items):
        raise IndexError(value)
    return index % len(items)


def _removed_at(items: list[str], rest: list[str]) -> list[str]:
    gone = {_at(items, value) for value in rest}
    return [item for index, item in enumerate(items) if index not in gone]


def _inserted(items: list[str], rest: list[str]) -> list[str]:
    index = _number(rest[0])
    return [*items[:index], *rest[1:], *items[index:]]


def _filtered(items: list[str], rest: list[str]) -> list[str]:
    keep = rest[0] == "INCLUDE"
    return [item for item in items if (_search(rest[2], item) is not None) is keep]


def _transformed(items: list[str], rest: list[str]) -> list[str]:
    action, *more = rest
    if action == "REPLACE" and len(more) >= 2:
        return [_substituted(more[0], more[1], item) for item in items]
    change: dict[str, Callable[[str], str]] = {
        "APPEND": lambda item: item + more[0],
        "PREPEND": lambda item: more[0] + item,
        "TOLOWER": str.lower,
        "TOUPPER": str.upper,
        "STRIP": str.strip,
    }
    if len(more) > (action in ("APPEND", "PREPEND")):
        raise ValueError(action)
    return [change[action](item) for item in items]


_CHANGES: dict[str, Change] = {
    "APPEND": lambda items, rest: items + rest,
    "PREPEND": lambda items, rest: rest + items,
    "REMOVE_ITEM": lambda items, rest: [item for item in items if item not in rest],
    "REMOVE_DUPLICATES": lambda items, _rest: list(dict.fromkeys(items)),
    "REMOVE_AT": _removed_at,
    "INSERT": _inserted,
    "REVERSE": lambda items, _rest: items[::-1],
    "SORT": lambda items, _rest: sorted(items),
    "FILTER": _filtered,
    "TRANSFORM": _transformed,
}
_QUERIES: dict[str, Callable[[list[str], list[str]], str]] = {
    "LENGTH": lambda items, _rest: str(len(items)),
    "GET": lambda items, rest: ";".join(items[_at(items, value)] for value in rest),
    "FIND": lambda items, rest: str(items.index(rest[0]) if rest[0] in items else -1),
    "JOIN": lambda items, rest: rest[0].join(items),
    "SUBLIST": lambda items, rest: ";".join(_sublist(items, _number(rest[0]), _number(rest[1]))),
}


def _sublist(items: list[str], begin: int, length: int) -> list[str]:
    return items[begin:] if length < 0 else items[begin : begin + length]


def _list(run: Evaluation, call: Call) -> None:
    if len(call.arguments) < 2:
        return
    action, name, *rest = call.arguments
    value = run.scope.get(name)[1] if run.scope.get(name)[0] else run.cache.get(name)
    items = items_of(value or "", empty=True)
    run.spend(len(value or "") + 50)
    unknown = hole(f"list({action})")
    try:
        if action in _CHANGES:
            if action not in _PLAIN and is_unknown(value or ""):
                run.set(name, unknown)
            else:
                result = _CHANGES[action](items, rest)
                run.set(name, ";".join(result) if result or value is not None else None)
        elif action in ("POP_BACK", "POP_FRONT"):
            taken = (items.pop() if action == "POP_BACK" else items.pop(0)) if items else None
            run.set(name, ";".join(items))
            for out in rest[:1]:
                run.set(out, taken)
        elif rest:
            run.set(rest[-1], unknown if is_unknown(value or "") else _QUERIES[action](items, rest[:-1]))
    except (IndexError, ValueError, LookupError):
        run.set(rest[-1] if rest and action in _QUERIES else name, unknown)


_PLAIN = frozenset({"APPEND", "PREPEND", "REMOVE_DUPLICATES", "REMOVE_ITEM"})


def _search(pattern: str, value: str) -> re.Match[str] | None:
    expression = expression_of(pattern)
    if expression is None or not searchable(expression, value):
        raise ValueError(pattern)
    return expression.search(value)


def _substituted(pattern: str, replacement: str, value: str) -> str:
    expression = expression_of(pattern)
    if expression is None or not searchable(expression, value):
        raise ValueError(pattern)

    def replaced(match: re.Match[str]) -> str:
        return re.sub(r"\\(\d)", lambda group: match[int(group[1])] or "", replacement)

    result = expression.sub(replaced, value)
    if len(result) > MOST_LENGTH:
        raise ValueError(pattern)
    return result


def _regex(run: Evaluation, rest: list[str]) -> None:
    action, pattern = rest[0], rest[1]
    if action == "REPLACE":
        run.set(rest[3], _known("".join(rest[4:]), lambda value: _substituted(pattern, rest[2], value)))
        return
    value = "".join(rest[3:])
    if is_unknown(value):
        run.set(rest[2], value)
        return
    if action == "MATCHALL":
        _search(pattern, value)
        expression = expression_of(pattern)
        run.set(rest[2], ";".join(match[0] for match in expression.finditer(value)) if expression else "")
        return
    match = _search(pattern, value)
    if match:
        run.matched([match[0], *(group or "" for group in match.groups())])
    run.set(rest[2], match[0] if match else "")


def _known(value: str, change: Callable[[str], str]) -> str:
    return value if is_unknown(value) else change(value)


def _replaced(run: Evaluation, rest: list[str]) -> None:
    value = "".join(rest[3:])
    if is_unknown(value):
        run.set(rest[2], value)
        return
    if rest[0] == "" or len(value) * (len(rest[1]) + 1) > 10 * MOST_LENGTH:
        raise ValueError(rest[0])
    run.set(rest[2], value.replace(rest[0], rest[1]))


def _appended(run: Evaluation, rest: list[str], *, first: bool = False) -> None:
    known, value = run.scope.get(rest[0])
    before = (value or "") if known else run.cache.get(rest[0], "")
    more = "".join(rest[1:])
    run.spend(len(before) + len(more))
    run.set(rest[0], more + before if first else before + more)


def _substring(run: Evaluation, rest: list[str]) -> None:
    begin, length = _number(rest[1]), _number(rest[2])
    run.set(rest[3], _known(rest[0], lambda value: value[begin:] if length < 0 else value[begin : begin + length]))


def _found(run: Evaluation, rest: list[str]) -> None:
    if is_unknown(rest[0]):
        run.set(rest[2], rest[0])
        return
    run.set(rest[2], str(rest[0].rfind(rest[1]) if "REVERSE" in rest[3:] else rest[0].find(rest[1])))


def _repeated(run: Evaluation, rest: list[str]) -> None:
    times = _number(rest[1])
    if times * len(rest[0]) > MOST_LENGTH:
        raise ValueError(rest[1])
    run.set(rest[2], rest[0] * times)


_COMPARES: dict[str, Callable[[str, str], bool]] = {
    "EQUAL": lambda one, other: one == other,
    "NOTEQUAL": lambda one, other: one != other,
    "LESS": lambda one, other: one < other,
    "GREATER": lambda one, other: one > other,
}


def _compared(run: Evaluation, rest: list[str]) -> None:
    if is_unknown(rest[1]) or is_unknown(rest[2]):
        run.set(rest[3], hole("string(COMPARE)"))
        return
    run.set(rest[3], "1" if _COMPARES[rest[0]](rest[1], rest[2]) else "0")


def _one(change: Callable[[str], str]) -> Callable[[Evaluation, list[str]], None]:
    return lambda run, rest: run.set(rest[1], _known(rest[0], change))


_STRINGS: dict[str, Callable[[Evaluation, list[str]], None]] = {
    "TOLOWER": _one(str.lower),
    "TOUPPER": _one(str.upper),
    "STRIP": _one(str.strip),
    "LENGTH": _one(lambda value: str(len(value.encode()))),
    "MAKE_C_IDENTIFIER": _one(lambda value: re.sub(r"^(?=\d)", "_", re.sub(r"\W", "_", value, flags=re.ASCII))),
    "REPLACE": _replaced,
    "REGEX": _regex,
    "APPEND": _appended,
    "PREPEND": lambda run, rest: _appended(run, rest, first=True),
    "CONCAT": lambda run, rest: run.set(rest[0], "".join(rest[1:])),
    "JOIN": lambda run, rest: run.set(rest[1], rest[0].join(rest[2:])),
    "SUBSTRING": _substring,
    "FIND": _found,
    "REPEAT": _repeated,
    "COMPARE": _compared,
}


def _string(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    action, *rest = call.arguments
    run.spend(sum(map(len, rest)))
    try:
        _STRINGS[action](run, rest)
    except (IndexError, ValueError, LookupError):
        for name in rest:
            if name.isidentifier():
                run.foreign.add(name)
                run.set(name, hole(f"string({action})"))


LIST_AND_STRING: dict[str, Handler] = {"list": _list, "string": _string}
