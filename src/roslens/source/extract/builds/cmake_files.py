"""The command ``file()`` of CMake: files of the package by patterns; what only a build could read is unknown."""

from __future__ import annotations

import re
from fnmatch import translate
from functools import lru_cache
from posixpath import relpath

from roslens.source.extract.builds.cmake_evaluation import Call, Evaluation, Handler
from roslens.source.extract.builds.cmake_value import hole, truth_of


def _file(run: Evaluation, call: Call) -> None:
    if len(call.arguments) < 2:
        return
    mode, variable, *rest = call.arguments
    if mode in ("GLOB", "GLOB_RECURSE"):
        run.variables.set(variable, ";".join(_globbed(run, rest, deep=mode == "GLOB_RECURSE")))
    elif mode == "RELATIVE_PATH" and len(rest) == 2:
        base, path = map(run.relative, rest)
        known = base is not None and path is not None
        run.variables.set(variable, relpath(f"/{path}", f"/{base}") if known else hole(f"file({mode})"))
    elif mode in _ASKING:
        run.variables.set(rest[0] if rest else variable, hole(f"file({mode})"))


_ASKING = frozenset(
    {"READ", "STRINGS", "TIMESTAMP", "REAL_PATH", "TO_CMAKE_PATH", "TO_NATIVE_PATH", "SIZE", "READ_SYMLINK", "MD5",
     "SHA1", "SHA224", "SHA256", "SHA384", "SHA512", "SHA3_224", "SHA3_256", "SHA3_384", "SHA3_512"}
)  # fmt: skip


def _globbed(run: Evaluation, arguments: list[str], *, deep: bool) -> list[str]:
    relative_to: str | None = None
    folders = not deep
    found: dict[str, None] = {}
    waiting = iter(arguments)
    for value in waiting:
        if value == "RELATIVE":
            relative_to = run.relative(next(waiting, ""))
        elif value == "LIST_DIRECTORIES":
            folders = truth_of(next(waiting, "")) is True
        elif value not in ("CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS"):
            pattern = run.relative(value)
            if pattern is not None:
                run.limits.spend(len(run.listing) * 10)
                found.update(dict.fromkeys(matching(pattern, run.listing, run.folders, deep=deep, folders=folders)))
    if relative_to is None:
        return [run.absolute(path) for path in sorted(found)]
    return sorted(relpath(f"/{path}", f"/{relative_to}") if path != relative_to else "" for path in found)


def matching(
    pattern: str, listing: frozenset[str], inner: frozenset[str], *, deep: bool, folders: bool | None = None
) -> list[str]:
    """Return the files that match a pattern of CMake, and the folders: of one that is not deep where nobody says."""
    *above, last = pattern.split("/")
    expressions = [_segment(piece) for piece in above]
    name = _segment(last)
    found = []
    for path in listing | inner if (folders is None and not deep) or folders else listing:
        pieces = path.split("/")
        if len(pieces) - 1 < len(above) or (len(pieces) - 1 > len(above) and not deep):
            continue
        # Of folders that are gone through, all are listed.
        named = name.match(pieces[-1]) or (deep and folders and path in inner)
        if named and all(expression.match(piece) for expression, piece in zip(expressions, pieces, strict=False)):
            found.append(path)
    return found


@lru_cache(maxsize=1024)
def _segment(pattern: str) -> re.Pattern[str]:
    try:
        return re.compile(translate(re.sub(r"\*+", "*", pattern[:200]).replace("[^", "[!")))
    except re.error:
        return re.compile(r"(?!)")


FILE: dict[str, Handler] = {"file": _file}
