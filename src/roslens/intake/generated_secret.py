"""Keys and tokens that roslens generates: 256 random bits, in a form that no text of a person's choice has.

Whoever listens to a handshake can try passphrases at home, a billion a second, and no look at a text tells how random
it is: long passphrases and hashes of short ones look like chance. So only what roslens generated is taken: a prefix for
its kind, 43 characters of base64 for URLs (256 bits), and the first 8 hexadecimal digits of the SHA-256 of both. The
check sum also finds a character that was lost on the way to another host.
"""

from __future__ import annotations

import re
import secrets
from base64 import urlsafe_b64encode
from enum import Enum
from hashlib import sha256

RANDOM_BITS = 256
_CHECK_DIGITS = 8
_EARLIER = re.compile(r"[0-9a-fA-F]{64}|[A-Za-z0-9_-]{43}")
"""What versions without check sums wrote."""


class Secret(Enum):
    """Kinds of secrets, each by its prefix."""

    KEY = "rlk_"
    TOKEN = "rlt_"  # noqa: S105 - what tokens begin with


def new_secret(kind: Secret) -> str:
    """Return a new secret of 256 random bits."""
    text = kind.value + urlsafe_b64encode(secrets.token_bytes(RANDOM_BITS // 8)).rstrip(b"=").decode("ascii")
    return text + _check_sum(text)


def not_generated(kind: Secret, text: str) -> str:
    """Return why a text is no secret of this kind that roslens generated; empty if it is."""
    name = kind.name.lower()
    if not text:
        return f"an empty {name}"
    size = f"a {name} of {len(text)} characters"
    other = next((one for one in Secret if one is not kind and text.startswith(one.value)), None)
    if other is not None:
        return f"a {other.name.lower()} where a {name} is needed"
    if not text.startswith(kind.value):
        earlier = (
            ", as earlier versions wrote and as the hash of a passphrase looks" if _EARLIER.fullmatch(text) else ""
        )
        return f"{size} that roslens did not generate{earlier}"
    if len(text) != _LENGTH or _check_sum(text[:-_CHECK_DIGITS]) != text[-_CHECK_DIGITS:]:
        return f"{size} whose check sum is wrong: something of it was changed or left out"
    return ""


def _check_sum(text: str) -> str:
    return sha256(text.encode()).hexdigest()[:_CHECK_DIGITS]


_LENGTH = len(new_secret(Secret.KEY))
