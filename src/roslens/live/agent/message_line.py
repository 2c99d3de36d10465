"""Messages on an encrypted line: a length of four bytes, then a letter and a body.

From the agent: ``C`` a challenge, ``D`` what became of a request (MessagePack of ``Done``). To it: ``R`` a request that
is signed (:mod:`roslens.live.agent.signed_request`).
"""

from __future__ import annotations

from collections.abc import Iterator

from roslens.live.agent.signed_request import MOST_BYTES

_PREFIX = 4


class LineError(ValueError):
    """The other side does not keep to the form; the line has to end."""


def message(letter: bytes, body: bytes) -> bytes:
    """Return a message as it goes over the line."""
    return (len(body) + 1).to_bytes(_PREFIX, "big") + letter + body


class MessageReader:
    """Cuts a stream, in any pieces, into messages."""

    def __init__(self) -> None:
        self._waiting = bytearray()

    def feed(self, piece: bytes) -> Iterator[tuple[bytes, bytes]]:
        """Add bytes and yield letter and body of each message that is complete.

        Raises:
            LineError: a message is empty or too long.
        """
        self._waiting += piece
        while len(self._waiting) >= _PREFIX:
            length = int.from_bytes(self._waiting[:_PREFIX], "big")
            if not 0 < length <= MOST_BYTES + 1:
                raise LineError(f"a message of {length:,} bytes, expected 1 to {MOST_BYTES + 1:,}")
            if len(self._waiting) < _PREFIX + length:
                return
            body = bytes(self._waiting[_PREFIX : _PREFIX + length])
            del self._waiting[: _PREFIX + length]
            yield body[:1], body[1:]
