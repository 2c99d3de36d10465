"""Which lines of a file of C or C++ the preprocessor leaves out, whatever is defined: those of ``#if 0``."""

from __future__ import annotations

import re
from collections.abc import Sequence

_OFF = re.compile(rb"#[ \t]*if[ \t]+(?:0|false)\b")
_DIRECTIVE = re.compile(rb"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|else|endif)\b([^\n]*)", re.MULTILINE)
_NEVER = re.compile(rb"[ \t]*(?:0|false)[ \t]*(?:$|//|/\*)")


def switched_off(code: bytes) -> Sequence[range]:
    """Return the lines, 1-based, between ``#if 0`` and what ends that arm.

    Args:
        code: without what stands in comments.
    """
    if _OFF.search(code) is None:
        return ()
    found: list[range] = []
    # Of each condition that is open: the line after which nothing counts; 0 where it may hold.
    open_since: list[int] = []
    line, seen = 1, 0
    for match in _DIRECTIVE.finditer(code):
        line += code.count(b"\n", seen, match.start(1))
        seen = match.start(1)
        word = match[1]
        if word in (b"if", b"ifdef", b"ifndef"):
            open_since.append(line if word == b"if" and _NEVER.match(match[2]) else 0)
        elif open_since:
            since = open_since.pop()
            if since:
                found.append(range(since, line + 1))
            if word != b"endif":
                open_since.append(0)
    return found
