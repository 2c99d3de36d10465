"""Values of parameters as text, of bearable length; what looks like a secret is not shown."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

HIDDEN = "***"
LONGEST = 200
"""Characters of a value; the robot's description has a million."""
_DEEPEST = 8
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_SECRET = frozenset(
    {"password", "passwd", "passphrase", "pwd", "secret", "secrets", "token", "tokens", "key", "keys", "apikey"}
    | {"credential", "credentials"}
)
_HARMLESS = re.compile(r"(^|[^a-z])public[_-]?key", re.IGNORECASE)
_LOGIN = re.compile(r"(://[^/\s:@]*:)[^/\s@]+(?=@)")


def is_secret(name: str) -> bool:
    """Return whether a name is that of a secret: a password, a token, a key.

    A word of the name decides, not a part of one: ``api_key`` and ``apiKey`` are secret, ``keyframe_rate`` is not.
    """
    words = {word.lower() for word in _WORD.findall(name[:1024])}
    return not words.isdisjoint(_SECRET) and not _HARMLESS.search(name)


def value_text(name: str, value: Any) -> str:
    """Return the value of a parameter as text; that of a secret is ``***``, and so is a password within an address."""
    return HIDDEN if is_secret(name) else _cut(_LOGIN.sub(rf"\1{HIDDEN}", _text(value, 0)))


def _text(value: Any, depth: int) -> str:
    if value is None:
        return "not set"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        # What is cut off is not looked through; an address and its password are short.
        return "".join(sign if sign.isprintable() else " " for sign in value[: 4 * LONGEST])
    if isinstance(value, (bytes, bytearray, memoryview)):
        return f"<{len(value):,} bytes>"
    if depth >= _DEEPEST:
        return "…"
    if isinstance(value, Mapping):
        pairs = (
            f"{key}: {HIDDEN if is_secret(str(key)) else _text(inner, depth + 1)}"
            for key, inner in list(value.items())[:LONGEST]
        )
        return f"{{{', '.join(pairs)}}}"
    if isinstance(value, Sequence):
        return f"[{', '.join(_text(inner, depth + 1) for inner in value[:LONGEST])}]"
    return str(value)


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 1]}…"
