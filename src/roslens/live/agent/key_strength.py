"""Whether a text can be a key: random, and too long for a brute-force search.

Whoever listens to a handshake can try keys at home, a billion a second. Words, names and repeated patterns are found
so, 256 random bits are not. How random a text is cannot be proven, but what people type differs from what chance
writes: in its alphabet, and in how often characters and sequences of them come again.
"""

from __future__ import annotations

import math
import re
from collections import Counter

RANDOM_BITS = 256
"""What a key has."""

_HEXADECIMAL = re.compile(rb"[0-9a-f]{64,}|[0-9A-F]{64,}")
_BASE64 = re.compile(rb"[A-Za-z0-9+/_-]{43,}={0,2}")
_KINDS = [re.compile(kind) for kind in (rb"[A-Z]", rb"[a-z]", rb"[0-9+/_-]")]
"""Random base64 of the least length has all three, but for one key in 7,000; words have not."""
_RAW_BYTES = RANDOM_BITS // 8
_SEQUENCE = 4
_DIFFERENT = 0.75
"""Share of sequences of four characters that are different ones; of 64 random hexadecimal digits it is 0.95 at least
but for one key in 10,000,000."""
_BITS_A_CHARACTER = {"hexadecimal": 3.0, "base64": 4.0, "raw": 4.0}
"""Shannon entropy of how often each character comes; of random keys of the least length 3.8, 4.9 and 4.9 on average."""


def weakness(key: bytes) -> str:
    """Return why a text is no key; empty if it looks as if it had 256 random bits.

    What is taken: 64 hexadecimal digits, 43 characters of base64, or 32 bytes that are no text.
    """
    if not key:
        return "an empty key"
    form = _form(key)
    if form == "":
        return f"a key of {len(key)} bytes that are not 64 hexadecimal digits or 43 characters of base64"
    counts = Counter(key)
    bits = -sum(count / len(key) * math.log2(count / len(key)) for count in counts.values())
    sequences = [key[at : at + _SEQUENCE] for at in range(len(key) - _SEQUENCE + 1)]
    if bits < _BITS_A_CHARACTER[form] or len(set(sequences)) < _DIFFERENT * len(sequences):
        return f"a key of {len(key)} bytes that repeat themselves as random ones do not"
    return ""


def _form(key: bytes) -> str:
    if _HEXADECIMAL.fullmatch(key):
        return "hexadecimal"
    if _BASE64.fullmatch(key) and all(kind.search(key) for kind in _KINDS):
        return "base64"
    try:
        key.decode("utf-8")
    except UnicodeDecodeError:
        return "raw" if len(key) >= _RAW_BYTES else ""
    return ""
