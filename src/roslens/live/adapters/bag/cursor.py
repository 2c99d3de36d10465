"""Little-endian numbers and texts out of bytes that may lie about their lengths."""

from __future__ import annotations

import struct

from roslens.live.adapters.bag.damage import DamageError

_U16 = struct.Struct("<H")
_U32 = struct.Struct("<I")
_U64 = struct.Struct("<Q")


class Cursor:
    """Reads one thing after the other.

    Raises:
        DamageError: from every method, where the bytes end too early.
    """

    def __init__(self, content: bytes) -> None:
        self._content = content
        self.at = 0

    @property
    def left(self) -> int:
        """Bytes that were not read yet."""
        return len(self._content) - self.at

    def take(self, length: int) -> bytes:
        """Return the next bytes."""
        if not 0 <= length <= self.left:
            raise DamageError(f"a length of {length:,} bytes where {self.left:,} are left")
        self.at += length
        return self._content[self.at - length : self.at]

    def u16(self) -> int:
        """Return two bytes as a number."""
        return int(_U16.unpack(self.take(2))[0])

    def u32(self) -> int:
        """Return four bytes as a number."""
        return int(_U32.unpack(self.take(4))[0])

    def u64(self) -> int:
        """Return eight bytes as a number."""
        return int(_U64.unpack(self.take(8))[0])

    def text(self) -> str:
        """Return a text that has its length in four bytes before it."""
        return self.take(self.u32()).decode(errors="replace")

    def table(self) -> dict[str, str]:
        """Return pairs of texts that have their length in bytes before them."""
        pairs = Cursor(self.take(self.u32()))
        found = {}
        while pairs.left:
            key = pairs.text()
            found[key] = pairs.text()
        return found
