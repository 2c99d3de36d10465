"""``cmake_parse_arguments()`` of CMake."""

from __future__ import annotations

from roslens.source.extract.builds.cmake_evaluation import Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_value import items_of


def _parse_arguments(run: Evaluation, call: Call) -> None:
    arguments = call.arguments
    raw = arguments[:1] == ["PARSE_ARGV"]
    if raw:
        arguments = arguments[2:6] + _given_raw(run, arguments)
    if len(arguments) < 4:
        return
    prefix, options, single, several = arguments[0], *map(items_of, arguments[1:4])
    for name in options:
        run.variables.set(f"{prefix}_{name}", "FALSE")
    for name in (*single, *several):
        run.variables.set(f"{prefix}_{name}", None)
    found, rest = _by_keyword(arguments[4:], options, single, several, raw=raw)
    for name in options:
        if name in arguments[4:]:
            run.variables.set(f"{prefix}_{name}", "TRUE")
    missing = _without_values(arguments[4:], options, {*single, *several})
    for name, values in (*found.items(), ("UNPARSED_ARGUMENTS", rest), ("KEYWORDS_MISSING_VALUES", missing)):
        run.variables.set(f"{prefix}_{name}", ";".join(values) if values else None)


def _given_raw(run: Evaluation, arguments: list[str]) -> list[str]:
    """Return the arguments of the function around; what was one stays one, so that a list in it is escaped."""
    first = int(arguments[1]) if len(arguments) > 2 and arguments[1].isdecimal() else 0
    count = run.variables.get("ARGC") or ""
    last = int(count) if count.isdecimal() else 0
    return [(run.variables.get(f"ARGV{at}") or "").replace(";", "\\;") for at in range(first, min(last, 100))]


def _by_keyword(
    values: list[str], options: list[str], single: list[str], several: list[str], *, raw: bool
) -> tuple[dict[str, list[str]], list[str]]:
    """Return the values behind each keyword, and those that stand behind none."""
    found: dict[str, list[str]] = {}
    rest: list[str] = []
    keyword = ""
    for value in values:
        if value in options:
            keyword = ""
        elif value in single or value in several:
            keyword = value
            found.setdefault(value, [])
        elif keyword in single:
            found[keyword] = [value.replace("\\;", ";") if raw else value]
            keyword = ""
        elif keyword:
            found[keyword].append(value)
        else:
            rest.append(value)
    return found, rest


def _without_values(arguments: list[str], options: list[str], keywords: set[str]) -> list[str]:
    """Return the keywords that no value follows, wherever they stand."""
    following = [*arguments[1:], ""]
    ends = {*options, *keywords}
    found = {
        value
        for at, value in enumerate(arguments)
        if value in keywords and (at == len(arguments) - 1 or following[at] in ends)
    }
    return sorted(found)


ARGUMENTS: dict[str, Handler] = {"cmake_parse_arguments": _parse_arguments}
