"""Codes of what a cache keeps, which only its user can make: what something else put there is not used.

Keyed BLAKE2b (RFC 7693) of the name and the content of an entry: an entry under another name is as little its user's.
"""

from __future__ import annotations

import hmac
from collections.abc import Mapping
from hashlib import blake2b

from roslens.intake.user_folder import user_secret

_SIZE = 16


class CacheCodes:
    """The codes of one user for one kind of entry."""

    def __init__(self, kind: str, environment: Mapping[str, str]) -> None:
        """``kind`` tells entries apart that have the same names."""
        self._key = hmac.digest(user_secret(environment), f"cache of roslens: {kind}".encode(), "sha256")

    def sealed(self, name: str, content: bytes) -> bytes:
        """Return content with its code."""
        return self._code(name, content) + content

    def opened(self, name: str, kept: object) -> bytes | None:
        """Return content that was kept with its code; None where something else wrote it."""
        if not isinstance(kept, bytes):
            return None
        content = kept[_SIZE:]
        return content if hmac.compare_digest(kept[:_SIZE], self._code(name, content)) else None

    def _code(self, name: str, content: bytes) -> bytes:
        # A name has no zero byte: where it ends is no matter of opinion.
        return blake2b(b"%b\0%b" % (name.encode(errors="replace"), content), digest_size=_SIZE, key=self._key).digest()
