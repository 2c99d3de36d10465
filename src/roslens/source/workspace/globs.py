"""Globs on paths: ``*`` and ``?`` stay within one folder, ``**`` spans any depth, ``[a-z]`` is one of these.

A pattern matches the path itself and everything below a folder of that path. A pattern without ``/`` matches at any
depth, as in a ``.gitignore``; one with ``/`` starts at the workspace root.
"""

from __future__ import annotations

import re
from collections.abc import Iterable


def compiled(patterns: Iterable[str]) -> re.Pattern[str] | None:
    """Return one regular expression for ``fullmatch`` on paths, or nothing where there is no pattern."""
    parts = [_expression(pattern) for pattern in patterns if pattern.strip("/")]
    return re.compile(f"(?:{'|'.join(parts)})(?:/.*)?", re.DOTALL) if parts else None


def _expression(pattern: str) -> str:
    parts = pattern.strip("/").removeprefix("./").split("/")
    if len(parts) == 1 and not pattern.startswith(("/", "./")):
        return "(?:.*/)?" + _part(parts[0])
    written = ""
    for number, part in enumerate(parts):
        last = number == len(parts) - 1
        if part == "**":
            written += ".+" if last else "(?:.*/)?"
        else:
            written += _part(part) + ("" if last else "/")
    return written


_PIECE = re.compile(r"\*+|\?|\[!?\]?[^\]/]*\]|.", re.DOTALL)


def _part(part: str) -> str:
    return "".join(_piece(match.group()) for match in _PIECE.finditer(part))


def _piece(piece: str) -> str:
    if piece[0] == "*":
        return "[^/]*"
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
