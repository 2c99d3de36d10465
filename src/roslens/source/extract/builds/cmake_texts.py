"""``string()`` of CMake; cmake-commands(7), *string*."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from roslens.source.extract.builds.cmake_evaluation import Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_limits import MOST_LENGTH
from roslens.source.extract.builds.cmake_value import expression_of, hole, is_unknown, searchable

_SPACE = " \t\n\r\f\v"


def stripped(value: str) -> str:
    """Return a text without white space around it."""
    return value.strip(_SPACE)


def searched(pattern: str, value: str) -> re.Match[str] | None:
    """Return what a regular expression finds first; ValueError where that is not to be known."""
    expression = expression_of(pattern)
    if expression is None or not searchable(expression, value):
        raise ValueError(pattern)
    return expression.search(value)


def substituted(pattern: str, replacement: str, value: str) -> str:
    """Return a text with what a regular expression finds replaced; ValueError where that is not to be known."""
    found: list[str] = []
    rest = value
    for match in _found_in_turn(pattern, value):
        found += [rest[: match.start()], _filled(replacement, match)]
        rest = rest[match.end() :]
    result = "".join([*found, rest])
    if len(result) > MOST_LENGTH:
        raise ValueError(pattern)
    return result


def _filled(replacement: str, match: re.Match[str]) -> str:
    return _REPLACED.sub(lambda one: _put(one[0], match), replacement)


_REPLACED = re.compile(r"\\(?s:.?)")


def _put(escape: str, match: re.Match[str]) -> str:
    sign = escape[1:]
    if sign.isdecimal():
        return match[int(sign)] or ""
    return {"n": "\n", "\\": "\\"}[sign]


def _found_in_turn(pattern: str, value: str) -> Iterator[re.Match[str]]:
    """Yield what is found, each in what the one before has left: ``^`` is the beginning of that too."""
    expression = expression_of(pattern)
    if expression is None or not searchable(expression, value):
        raise ValueError(pattern)
    rest = value
    while match := expression.search(rest):
        if not match[0]:
            raise ValueError(pattern)
        yield match
        rest = rest[match.end() :]


def _regex(run: Evaluation, rest: list[str]) -> None:
    action, pattern = rest[0], rest[1]
    value = "".join(rest[4 if action == "REPLACE" else 3 :])
    run.variables.matched(())
    if action == "REPLACE":
        run.variables.set(rest[3], _known(value, lambda value: substituted(pattern, rest[2], value)))
        last = None if is_unknown(value) else [*_found_in_turn(pattern, value)][-1:]
    elif is_unknown(value):
        run.variables.set(rest[2], value)
        return
    elif action == "MATCHALL":
        last = [*_found_in_turn(pattern, value)]
        run.variables.set(rest[2], ";".join(match[0] for match in last))
    else:
        match = searched(pattern, value)
        last = [match] if match else []
        run.variables.set(rest[2], match[0] if match else "")
    if last:
        run.variables.matched((last[-1][0], *(group or "" for group in last[-1].groups())))


def _known(value: str, change: Callable[[str], str]) -> str:
    return value if is_unknown(value) else change(value)


def _replaced(run: Evaluation, rest: list[str]) -> None:
    value = "".join(rest[3:])
    if is_unknown(value):
        run.variables.set(rest[2], value)
        return
    if rest[0] == "" or len(value) * (len(rest[1]) + 1) > 10 * MOST_LENGTH:
        raise ValueError(rest[0])
    run.variables.set(rest[2], value.replace(rest[0], rest[1]))


def _appended(run: Evaluation, rest: list[str], *, first: bool = False) -> None:
    before = run.variables.kept(rest[0]) or ""
    more = "".join(rest[1:])
    run.limits.spend(len(before) + len(more))
    run.variables.set(rest[0], more + before if first else before + more)


def number_in(value: str) -> int:
    """Return a whole number; ValueError where it is none."""
    if not re.fullmatch(r"[+-]?\d{1,9}", value, re.ASCII):
        raise ValueError(value)
    return int(value)


def _substring(run: Evaluation, rest: list[str]) -> None:
    begin, length = number_in(rest[1]), number_in(rest[2])
    run.variables.set(
        rest[3], _known(rest[0], lambda value: value[begin:] if length < 0 else value[begin : begin + length])
    )


def _found(run: Evaluation, rest: list[str]) -> None:
    if is_unknown(rest[0]):
        run.variables.set(rest[2], rest[0])
        return
    run.variables.set(rest[2], str(rest[0].rfind(rest[1]) if "REVERSE" in rest[3:] else rest[0].find(rest[1])))


def _repeated(run: Evaluation, rest: list[str]) -> None:
    times = number_in(rest[1])
    if times * len(rest[0]) > MOST_LENGTH:
        raise ValueError(rest[1])
    run.variables.set(rest[2], rest[0] * times)


_COMPARES: dict[str, Callable[[str, str], bool]] = {
    "EQUAL": lambda one, other: one == other,
    "NOTEQUAL": lambda one, other: one != other,
    "LESS": lambda one, other: one < other,
    "GREATER": lambda one, other: one > other,
    "LESS_EQUAL": lambda one, other: one <= other,
    "GREATER_EQUAL": lambda one, other: one >= other,
}


def _compared(run: Evaluation, rest: list[str]) -> None:
    if is_unknown(rest[1]) or is_unknown(rest[2]):
        run.variables.set(rest[3], hole("string(COMPARE)"))
        return
    run.variables.set(rest[3], "1" if _COMPARES[rest[0]](rest[1], rest[2]) else "0")


def _configured(run: Evaluation, rest: list[str]) -> None:
    text, out, *options = rest
    if is_unknown(text) or "ESCAPE_QUOTES" in options or "$" in "".join(re.findall(r"\$\{([^}]*)", text)):
        raise ValueError(text)
    escapes = "ESCAPE_QUOTES" in options

    def quoted(value: str) -> str:
        return value.replace('"', '\\"') if escapes else value

    expression = _AT if "@ONLY" in options else _AT_OR_REFERENCE
    value = expression.sub(lambda match: quoted(run.variables.get(next(filter(None, match.groups()))) or ""), text)
    run.limits.spend(len(value))
    run.variables.set(out, value)


_AT = re.compile(r"@([A-Za-z0-9/_.+-]+)@")
_AT_OR_REFERENCE = re.compile(rf"{_AT.pattern}|\$\{{([A-Za-z0-9/_.+-]+)\}}")


def _one(change: Callable[[str], str]) -> Callable[[Evaluation, list[str]], None]:
    return lambda run, rest: run.variables.set(rest[1], _known(rest[0], change))


_STRINGS: dict[str, Callable[[Evaluation, list[str]], None]] = {
    "TOLOWER": _one(str.lower),
    "TOUPPER": _one(str.upper),
    "STRIP": _one(stripped),
    "LENGTH": _one(lambda value: str(len(value.encode()))),
    "MAKE_C_IDENTIFIER": _one(lambda value: re.sub(r"^(?=\d)", "_", re.sub(r"\W", "_", value, flags=re.ASCII))),
    "REPLACE": _replaced,
    "REGEX": _regex,
    "APPEND": _appended,
    "PREPEND": lambda run, rest: _appended(run, rest, first=True),
    "CONCAT": lambda run, rest: run.variables.set(rest[0], "".join(rest[1:])),
    "JOIN": lambda run, rest: run.variables.set(rest[1], rest[0].join(rest[2:])),
    "SUBSTRING": _substring,
    "FIND": _found,
    "REPEAT": _repeated,
    "COMPARE": _compared,
    "CONFIGURE": _configured,
    "ASCII": lambda run, rest: run.variables.set(rest[-1], "".join(chr(number_in(code)) for code in rest[:-1])),
    "HEX": _one(lambda value: value.encode().hex()),
}


def _string(run: Evaluation, call: Call) -> None:
    if not call.arguments:
        return
    action, *rest = call.arguments
    run.limits.spend(sum(map(len, rest)))
    try:
        _STRINGS[action](run, rest)
    except (IndexError, ValueError, LookupError):
        for name in rest:
            if name.isidentifier():
                run.variables.foreign.add(name)
                run.variables.set(name, hole(f"string({action})"))


STRING: dict[str, Handler] = {"string": _string}
