"""Requests as they come to an agent: signed with the command key, and good for one short moment on one host alone.

An agent gives out challenges, random and new every second. A request holds one of them, a number that is above those of
all requests before it, and the name of its host; it is signed (HMAC-SHA256) with the command key of that host. So one
that was made up, changed, heard elsewhere, kept back or heard before is refused, without comparing clocks.
"""

from __future__ import annotations

import hmac
import secrets
from collections import deque

import msgspec

from roslens.model.acting.action_kind import By, action_kind
from roslens.model.acting.host_request import HostRequest

VERSION = 1
CHALLENGE_BYTES = 16
CODE_BYTES = 32
MOST_BYTES = 65_536
"""Of a request with its code."""

FRESH_S = 3.0
"""A challenge is good for so long; one that was answered later was held up."""

_LABEL = b"roslens request"
_MOST_CHALLENGES = 16
_LONGEST_NAME = 1024
_MOST_BESIDE = 1000


class Signed(msgspec.Struct, frozen=True, array_like=True, forbid_unknown_fields=True):
    """What is signed.

    Attributes:
        version: of the format.
        host: that it is meant for.
        challenge: that it answers.
        number: above those of all requests before it.
        request: what is asked.
    """

    version: int
    host: str
    challenge: bytes
    number: int
    request: HostRequest


class RefusedError(ValueError):
    """A request that is not trusted; the text states the reason."""


_ENCODER = msgspec.msgpack.Encoder()
_DECODER = msgspec.msgpack.Decoder(Signed)


def sign(signed: Signed, key: bytes) -> bytes:
    """Return a request as it goes over the line.

    Raises:
        RefusedError: it is longer than an agent takes.
    """
    body = _ENCODER.encode(signed)
    if len(body) + CODE_BYTES > MOST_BYTES:
        raise RefusedError(f"a request of {len(body):,} bytes, expected at most {MOST_BYTES - CODE_BYTES:,}")
    return _code(key, body) + body


class Believing:
    """Decides whether each request is trusted; one for each connection, so that no request is valid for two.

    Times are seconds on a clock that never jumps.
    """

    def __init__(self, host: str, key: bytes) -> None:
        """Believe what is signed with ``key`` and meant for ``host``."""
        self._host = host
        self._key = key
        self._challenges: deque[tuple[bytes, float]] = deque(maxlen=_MOST_CHALLENGES)
        self._number = -1

    def challenge(self, now: float) -> bytes:
        """Return a new challenge."""
        made = secrets.token_bytes(CHALLENGE_BYTES)
        self._challenges.append((made, now))
        return made

    def believed(self, message: bytes, now: float) -> HostRequest:
        """Return the request in a message.

        Raises:
            RefusedError: it is not to be believed.
        """
        if not CODE_BYTES < len(message) <= MOST_BYTES:
            raise RefusedError(f"{len(message):,} bytes, expected {CODE_BYTES + 1} to {MOST_BYTES:,}")
        code, body = message[:CODE_BYTES], message[CODE_BYTES:]
        if not hmac.compare_digest(code, _code(self._key, body)):
            raise RefusedError("it is not signed with the command key of this host")
        try:
            signed = _DECODER.decode(body)
        except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
            raise RefusedError(f"it is not a request: {error}") from None
        if signed.version != VERSION:
            raise RefusedError(f"it is of version {signed.version}, expected {VERSION}: update the older side")
        if signed.host != self._host:
            raise RefusedError(f"it is meant for {signed.host[:60]!r}")
        given = next((at for one, at in self._challenges if hmac.compare_digest(one, signed.challenge)), None)
        if given is None:
            raise RefusedError("it answers no challenge of this connection")
        if now - given > FRESH_S:
            raise RefusedError(f"it answers a challenge of {now - given:.1f} s ago, expected at most {FRESH_S:g} s")
        if signed.number <= self._number:
            raise RefusedError(
                f"it has the number {signed.number}, and {self._number} was there before: it is repeated"
            )
        self._number = signed.number
        if why := _senseless(signed.request):
            raise RefusedError(why)
        return signed.request


def _senseless(request: HostRequest) -> str:
    """Return what is wrong with a request by itself, empty where nothing is."""
    kind = action_kind(request.kind)
    if kind is None or kind.by is not By.HOST:
        return f"{request.kind[:60]!r} is nothing that a host does"
    names = (request.id, request.node, *request.beside)
    if len(request.beside) > _MOST_BESIDE or any(len(one) > _LONGEST_NAME or not one.isprintable() for one in names):
        return "it has names that are none"
    if not 0 <= request.pid < 2**31 or request.pid == 1:
        return f"{request.pid} is not a process of a node"
    if unknown := [one for one in request.arguments if kind.argument(one) is None]:
        return f"`{kind.key}` has no argument {unknown[0][:60]!r}"
    return ""


def _code(key: bytes, body: bytes) -> bytes:
    return hmac.digest(key, _LABEL + body, "sha256")
