"""The key of a journal: who has it, and which entry it signed last.

Hashes show a change only to whoever kept one of them: who can write the file can hash all of it anew. So each entry
also has a code that only the key makes (HMAC-SHA256 of its hash), and outside the journal is kept which was the last.
"""

from __future__ import annotations

import hmac
import os
from contextlib import suppress
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded

_LARGEST = 1000


class Anchor(msgspec.Struct, frozen=True):
    """The last entry that was signed: its number and its hash."""

    n: int
    hash: str


class Signing(msgspec.Struct, frozen=True):
    """What a journal is signed with.

    Attributes:
        key: secret of its user, and of its folder.
        last: file of this user with the last entry that was signed.
    """

    key: bytes
    last: Path

    def code(self, entry_hash: str) -> str:
        """Return the code of an entry, in hexadecimal."""
        return hmac.new(self.key, entry_hash.encode(), "sha256").hexdigest()

    def made(self, code: str, entry_hash: str) -> bool:
        """Return whether a code is that of an entry."""
        return hmac.compare_digest(code.encode(), self.code(entry_hash).encode())

    def anchor(self) -> Anchor | None:
        """Return the last entry that was signed; None where none was."""
        try:
            return msgspec.json.decode(read_bounded(self.last, _LARGEST), type=Anchor)
        except (OSError, msgspec.DecodeError):
            return None

    def keep(self, n: int, entry_hash: str) -> None:
        """Remember the last entry that was signed; where that cannot be kept, the codes alone have to do."""
        beside = self.last.with_name(f".{self.last.name}.{os.getpid()}")
        with suppress(OSError):
            self.last.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            with os.fdopen(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600), "wb") as file:
                file.write(msgspec.json.encode(Anchor(n, entry_hash)))
            beside.replace(self.last)
