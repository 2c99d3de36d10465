"""Which lines of a file of C or C++ the preprocessor leaves out, whatever is defined.

Those of ``#if 0``, and of an ``#ifdef`` right behind the ``#undef`` of its name, by which headers hold documentation.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

_OFF = re.compile(rb"#[ \t]*if[ \t]+(?:0|false)\b")
_UNDEFINED = re.compile(rb"(#[ \t]*undef[ \t]+(\w+)\s+#[ \t]*)ifdef[ \t]+\2\b")
_DIRECTIVE = re.compile(rb"^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|else|endif)\b([^\n]*)", re.MULTILINE)
_NEVER = re.compile(rb"[ \t]*(?:0|false)[ \t]*(?:$|//|/\*)")


def switched_off(code: bytes) -> Sequence[range]:
    """Return the lines, 1-based, between what never holds and what ends that arm.

    Args:
        code: without what stands in comments.
    """
    code = _UNDEFINED.sub(rb"\1if 0", code)
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
