"""The line from an agent to the monitor: one TCP connection, authenticated by a key that both sides share.

Both sides prove that they know the key before a record is taken, the agent first, and every message carries a code that
only who knows the key can make (HMAC-SHA256 over its number and content), so that nothing can be put in between. What
both greetings said, and which side said it, is in every proof and code: the session key is the HMAC with the shared key
over ``roslens link agent``, the agent's version and nonce, ``monitor``, the monitor's version and nonce. So neither a
version that was changed on the way nor an answer of one side that is put into the mouth of the other passes. A monitor
may know several keys, and tells by the agent's proof which one is meant. Contents are not encrypted. While the line is
down, frames wait in a bounded queue; what does not fit is counted as shed.

A message is a length (4 bytes), a letter, a body and a code (16 bytes)::

    H  hello: version, nonce        A  answer: proof          F  frame (roslens.model.wire)
    T  ask for the time: t1         t  time: t1, t2, t3 (seconds, IEEE doubles)
    P  pids that hold nodes, as the monitor knows from the graph (MessagePack array)
"""

from __future__ import annotations

import hmac
import secrets
import struct
from collections import deque
from collections.abc import Iterable, Iterator

import msgspec

from roslens.model.wire import MAX_FRAME_BYTES, Frame, WireError, decode_frame, encode_frame

LINK_VERSION = 3
"""Of the handshake. 3 has version and roles in the session key, and the agent proves first."""
NONCE_BYTES = 16
CODE_BYTES = 16
MIN_KEY_BYTES = 32
MOST_KEYS = 64
"""Keys of a monitor; each costs two codes for everybody who connects."""
_LENGTH = struct.Struct(">I")
_NUMBER = struct.Struct(">Q")
_ONE_TIME = struct.Struct(">d")
_THREE_TIMES = struct.Struct(">ddd")
_OVERHEAD = 1 + CODE_BYTES


class LinkError(ValueError):
    """The other side is no roslens, does not know the key, or broke the protocol; the connection has to end."""


class StrangerError(LinkError):
    """The other side speaks something else."""


class Channel:
    """One side of a connection, without its socket: bytes in, messages out, and the other way round.

    ``accepting`` is the monitor's side. Nothing but the handshake is taken before both have proven the key.

    Attributes:
        key: the place of the key that both proved among those that were given, None before.
    """

    def __init__(self, *keys: bytes, accepting: bool, nonce: bytes | None = None) -> None:
        """Begin a connection, an agent with one key.

        Raises:
            LinkError: a key is too short to be one, or there are too many.
        """
        short = min(map(len, keys))
        if short < MIN_KEY_BYTES:
            raise LinkError(f"a key of {short} bytes, expected at least {MIN_KEY_BYTES}")
        if len(keys) > (MOST_KEYS if accepting else 1):
            raise LinkError(f"{len(keys)} keys, expected at most {MOST_KEYS if accepting else 1}")
        self._keys = keys
        self._accepting = accepting
        self._nonce = nonce if nonce is not None else secrets.token_bytes(NONCE_BYTES)
        self._greetings = b""
        self._session = b""
        self.key: int | None = None
        self._waiting = bytearray()
        self._sent = 0
        self._received = 0

    @property
    def ready(self) -> bool:
        """Whether both sides have proven that they know the key."""
        return self.key is not None

    @property
    def greeted(self) -> bool:
        """Whether the other side has said that it is an agent or a monitor."""
        return bool(self._greetings)

    def hello(self) -> bytes:
        """Return the first bytes to send."""
        body = b"H" + bytes([LINK_VERSION]) + self._nonce
        return _LENGTH.pack(len(body)) + body

    def feed(self, piece: bytes) -> Iterator[tuple[str, bytes]]:
        """Take received bytes; yields ``("send", bytes)`` to send on, and ``(letter, body)`` of each message.

        Raises:
            LinkError: what was received is wrong; the connection has to be closed.
        """
        self._waiting += piece
        while len(self._waiting) >= _LENGTH.size:
            (length,) = _LENGTH.unpack_from(self._waiting)
            if length > (MAX_FRAME_BYTES + _OVERHEAD if self.ready else 64):
                raise self._stranger(f"a message of {length:,} bytes")
            if len(self._waiting) < _LENGTH.size + length:
                return
            message = bytes(self._waiting[_LENGTH.size : _LENGTH.size + length])
            del self._waiting[: _LENGTH.size + length]
            yield from self._take(message)

    def message(self, letter: str, body: bytes) -> bytes:
        """Return a message as it is sent.

        Raises:
            LinkError: the other side has not proven that it knows the key.
        """
        if not self.ready:
            raise LinkError(f"a message {letter!r} before the handshake was done")
        content = letter.encode() + body
        code = self._code(content, self._sent, mine=True)
        self._sent += 1
        return _LENGTH.pack(len(content) + CODE_BYTES) + content + code

    def _take(self, message: bytes) -> Iterator[tuple[str, bytes]]:
        letter = message[:1]
        if self.ready:
            content, code = message[:-CODE_BYTES], message[-CODE_BYTES:]
            if not content or not hmac.compare_digest(code, self._code(content, self._received, mine=False)):
                raise LinkError("a message whose code is wrong: it was changed, repeated or left out on the way")
            self._received += 1
            yield content[:1].decode("ascii", "replace"), content[1:]
        elif letter == b"H" and not self.greeted:
            self._greet(message)
            if not self._accepting:
                self._session = self._session_of(self._keys[0])
                yield "send", self._answer()
        elif letter == b"A" and self.greeted:
            self._believe(message[1:])
            if self._accepting:
                yield "send", self._answer()
            yield "ready", b""
        else:
            raise self._stranger(repr(message[:20]))

    def _greet(self, message: bytes) -> None:
        if len(message) != 2 + NONCE_BYTES:
            raise self._stranger(repr(message[:20]))
        if message[1] != LINK_VERSION:
            raise LinkError(
                f"the other side speaks version {message[1]}, expected {LINK_VERSION}: update the older one"
            )
        if message[2:] == self._nonce:
            raise LinkError("our own greeting came back")
        mine, theirs = bytes([LINK_VERSION]) + self._nonce, message[1:]
        agent, monitor = (theirs, mine) if self._accepting else (mine, theirs)
        self._greetings = b"roslens link agent" + agent + b"monitor" + monitor

    def _believe(self, proof: bytes) -> None:
        """Take the other side's proof, of whichever key; a monitor learns from it which one is meant.

        Raises:
            LinkError: it is one of none of the keys.
        """
        for number, key in enumerate(self._keys):
            self._session = self._session_of(key)
            if hmac.compare_digest(proof, self._proof(mine=False)):
                self.key = number
                return
        raise LinkError("the other side does not know the key: give both the same --key-file")

    def _session_of(self, key: bytes) -> bytes:
        return hmac.digest(key, self._greetings, "sha256")

    def _answer(self) -> bytes:
        body = b"A" + self._proof(mine=True)
        return _LENGTH.pack(len(body)) + body

    def _stranger(self, what: str) -> LinkError:
        text = f"{what}, expected a roslens agent or monitor to speak"
        return LinkError(text) if self.ready else StrangerError(text)

    def _side(self, *, mine: bool) -> bytes:
        return b"monitor" if self._accepting == mine else b"agent"

    def _proof(self, *, mine: bool) -> bytes:
        return hmac.digest(self._session, b"proof of " + self._side(mine=mine), "sha256")

    def _code(self, content: bytes, number: int, *, mine: bool) -> bytes:
        signed = self._side(mine=mine) + _NUMBER.pack(number) + content
        return hmac.digest(self._session, signed, "sha256")[:CODE_BYTES]


def frame_body(frame: Frame) -> bytes:
    """Return the body of an ``F`` message."""
    return encode_frame(frame)[_LENGTH.size :]


def read_frame(body: bytes) -> Frame:
    """Read the body of an ``F`` message.

    Raises:
        LinkError: it is no frame.
    """
    try:
        return decode_frame(body)
    except WireError as error:
        raise LinkError(str(error)) from None


def asked_time(sent: float) -> bytes:
    """Return the body of a ``T`` message."""
    return _ONE_TIME.pack(sent)


def reported_time(body: bytes, received: float, sent: float) -> bytes:
    """Return the body of the ``t`` message that answers a ``T``.

    Raises:
        LinkError: the ``T`` has no time.
    """
    if len(body) != _ONE_TIME.size:
        raise LinkError(f"{len(body)} bytes that ask for the time, expected {_ONE_TIME.size}")
    return _THREE_TIMES.pack(_ONE_TIME.unpack(body)[0], received, sent)


def read_times(body: bytes) -> tuple[float, float, float]:
    """Return when it was asked, when that was received and when the answer was sent.

    Raises:
        LinkError: the ``t`` message has no three times.
    """
    if len(body) != _THREE_TIMES.size:
        raise LinkError(f"{len(body)} bytes for clock times, expected {_THREE_TIMES.size}")
    asked, received, sent = _THREE_TIMES.unpack(body)
    return asked, received, sent


def named_pids(pids: Iterable[int]) -> bytes:
    """Return the body of a ``P`` message."""
    return msgspec.msgpack.encode(sorted(pids))


def read_pids(body: bytes) -> list[int]:
    """Return the process ids of a ``P`` message.

    Raises:
        LinkError: it holds anything else.
    """
    try:
        return msgspec.msgpack.decode(body, type=list[int])
    except (msgspec.DecodeError, RecursionError) as error:
        raise LinkError(f"{len(body)} bytes that are not process ids: {error}") from None


class Outbox:
    """Frames that wait for the line, the oldest given up when there are too many."""

    def __init__(self, most_frames: int = 6000, most_bytes: int = 8_000_000) -> None:
        """Keep at most so many frames and bytes: ten minutes of few nodes, a minute of a hundred."""
        self._bodies: deque[tuple[int, bytes]] = deque()
        self._most_frames = most_frames
        self._most_bytes = most_bytes
        self._bytes = 0
        self._shed = 0

    def __len__(self) -> int:
        """How many frames wait."""
        return len(self._bodies)

    def put(self, frame: Frame) -> None:
        """Add a frame, with the number of records that were dropped before it."""
        if self._shed:
            frame = msgspec.structs.replace(frame, shed=frame.shed + self._shed)
            self._shed = 0
        body = frame_body(frame)
        records = len(frame.tallies) + len(frame.samples) + len(frame.events) + frame.shed
        self._bodies.append((records, body))
        self._bytes += len(body)
        while self._bodies and (len(self._bodies) > self._most_frames or self._bytes > self._most_bytes):
            records, gone = self._bodies.popleft()
            self._bytes -= len(gone)
            self._shed += records

    def take(self) -> bytes | None:
        """Return the body of the oldest frame, None where nothing waits."""
        if not self._bodies:
            return None
        _, body = self._bodies.popleft()
        self._bytes -= len(body)
        return body
