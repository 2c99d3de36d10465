"""Globs on paths: ``*`` and ``?`` stay within one folder, ``**`` spans any depth, ``[a-z]`` is one of these.

A pattern matches the path itself and everything below a folder of that path. A pattern without ``/`` matches at any
depth, as in a ``.gitignore``; one with ``/`` starts at the workspace root.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import count


def compiled(patterns: Iterable[str]) -> re.Pattern[str] | None:
    """Return one regular expression for ``fullmatch`` on paths, or nothing where there is no pattern.

    However many ``*`` and ``**`` a pattern has, a path that does not match is refused in a time that grows with its
    length and not with a power of it: what stands between two of them is taken where it comes first, for good.
    """
    groups = count()
    parts = [_expression(pattern, groups) for pattern in patterns if pattern.strip("/")]
    return re.compile(f"(?:{'|'.join(parts)})(?:/.*)?", re.DOTALL) if parts else None


def _expression(pattern: str, groups: Iterator[int]) -> str:
    parts = pattern.strip("/").removeprefix("./").split("/")
    if len(parts) == 1 and not pattern.startswith(("/", "./")):
        return "(?:.*/)?" + _part(parts[0], groups)
    first, *others = _runs(parts)
    written = "".join(_part(part, groups) + "/" for part in first)
    if not others:
        return written[:-1]
    *between, last = others
    for run in between:
        inside = "".join(_part(part, groups) + "/" for part in run)
        written += _for_good(f"(?:.*?/)??{inside}", groups)
    return written + ("(?:.*/)?" + "/".join(_part(part, groups) for part in last) if last else ".+")


def _runs(parts: Sequence[str]) -> list[list[str]]:
    """Return what stands before, between and behind the ``**`` of a pattern; nothing stands between two in a row."""
    runs: list[list[str]] = [[]]
    for part in parts:
        if part != "**":
            runs[-1].append(part)
        elif len(runs) == 1 or runs[-1]:
            runs.append([])
    return runs


def _for_good(expression: str, groups: Iterator[int]) -> str:
    """Return an expression whose first match is its only one; Python has atomic groups from 3.11 on."""
    name = f"g{next(groups)}"
    return f"(?=(?P<{name}>{expression}))(?P={name})"


_PIECE = re.compile(r"\*+|\?|\[!?\]?[^\]/]*\]|.", re.DOTALL)


def _part(part: str, groups: Iterator[int]) -> str:
    """Return the expression of what stands between two slashes."""
    texts = [""]
    for match in _PIECE.finditer(part):
        if match.group()[0] == "*":
            texts.append("")
        else:
            texts[-1] += _piece(match.group())
    first, *others = texts
    if not others:
        return first
    *between, last = others
    return first + "".join(_for_good("[^/]*?" + text, groups) for text in between) + "[^/]*" + last


def _piece(piece: str) -> str:
    if piece == "?":
        return "[^/]"
    if len(piece) > 2 and piece[0] == "[":
        inside = piece[1:-1]
        negated = inside[0] == "!" and len(inside) > 1
        chosen = inside[1:] if negated else inside
        written = f"[{'^/' if negated else ''}{_escaped_set(chosen)}]"
        return written if _valid(written) else re.escape(piece)
    return re.escape(piece)


def _escaped_set(inside: str) -> str:
    return re.sub(r"[\\\[\]^&~|]", lambda match: "\\" + match.group(), inside)


def _valid(expression: str) -> bool:
    try:
        re.compile(expression)
    except re.error:
        return False
    return True
