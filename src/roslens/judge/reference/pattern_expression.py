"""A pattern on names as a regular expression of RE2, which Prometheus and Grafana read."""

from __future__ import annotations

import re

from roslens.judge.patterns.pattern import REGULAR_EXPRESSION
from roslens.judge.reference.alternatives import alternatives

_SIGNS = re.compile(r"\{,\*\*/\}|\\.|\*+/?|\?|.", re.DOTALL)
_ANY_DEPTH = "{,**/}"
_NOT_IN_RE2 = re.compile(r"\(\?#|\\[ZNuU]|\(\?[a-zA-Z]*[aLux]")
"""Comments, Python's end of text, names and numbers of characters, and some flags: RE2 has not got them.

What else it has not got, as looking around, no :class:`roslens.judge.patterns.pattern.Pattern` has either.
"""


def expression_of(pattern: str) -> str | None:
    """Return the expression, which has to match the whole name; None where RE2 has no such expression.

    Args:
        pattern: that :class:`roslens.judge.patterns.pattern.Pattern` has read.

    Raises:
        ValueError: the braces of the pattern list too much.
    """
    if pattern.startswith(REGULAR_EXPRESSION):
        found = pattern.removeprefix(REGULAR_EXPRESSION)
        return None if _NOT_IN_RE2.search(found) else found
    parts = ["".join(map(_piece, _SIGNS.findall(one))) for one in alternatives(pattern)]
    return parts[0] if len(parts) == 1 else f"(?:{'|'.join(parts)})"


def _piece(sign: str) -> str:
    if sign == _ANY_DEPTH:
        return "(?:.*/)?"
    if sign.startswith("*"):
        stars = sign.rstrip("/")
        any_ = ".*" if len(stars) > 1 else "[^/]*"
        return any_ + "/" * (len(sign) - len(stars))
    if sign == "?":
        return "[^/]"
    return _plain(sign[1:] if sign.startswith("\\") and len(sign) > 1 else sign)


def _plain(char: str) -> str:
    # `re.escape` escapes what RE2 refuses to see escaped, as a space.
    return f"\\{char}" if char in r"\.+*?()|[]{}^$" else char
