"""What an agent does with each request: believes it or not, carries it out or not, and writes down both."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Protocol

from roslens.live.agent.signed_request import Believing, RefusedError
from roslens.model.acting.host_request import HostRequest

MOST_REQUESTS = 20
"""Requests that are believed in :data:`PER_S` seconds; those that follow are refused."""

MOST_STRANGE = 100
"""Messages that are not believed in :data:`PER_S` seconds; who sends more is hung up on."""

MOST_WRITTEN = 10
"""Refusals that are written down in :data:`PER_S` seconds each; of more, their number."""

PER_S = 60.0


class TooMuchError(ValueError):
    """Whoever is at the other end sends nothing but what is refused; the line has to end."""


class Hand(Protocol):
    """Carries out."""

    def refusal(self, request: HostRequest) -> str:
        """Return why a request is refused, empty where it may be carried out."""

    def begin(self, request: HostRequest) -> None:
        """Begin to carry a request out; returns at once."""


class RequestGate:
    """Takes the messages of one monitor, over all its connections.

    Args:
        hand: carries out.
        write: writes a refusal into the journal; what it raises keeps nothing from being refused.
        refused: tells the monitor why a request that is believed is not done.
    """

    def __init__(self, hand: Hand, write: Callable[[str], None], refused: Callable[[HostRequest, str], None]) -> None:
        self._hand = hand
        self._write = write
        self._refused = refused
        self._believed_at: deque[float] = deque(maxlen=MOST_REQUESTS)
        self._strange_at: deque[float] = deque(maxlen=MOST_STRANGE)
        self._written_at: deque[float] = deque(maxlen=MOST_WRITTEN)
        self._unwritten = 0

    def take(self, message: bytes, believing: Believing, now: float, peer: str) -> None:
        """Take a message that came over a connection from ``peer``.

        Raises:
            TooMuchError: too many were not to be believed.
        """
        try:
            request = believing.believed(message, now)
        except RefusedError as error:
            self._write_down(f"a message from {peer} is refused: {error}", now)
            self._strange_at.append(now)
            if _full(self._strange_at, now):
                raise TooMuchError(f"{MOST_STRANGE} messages of {peer} in {PER_S:g} s were refused") from None
            return
        if _full(self._believed_at, now):
            why = f"more than {MOST_REQUESTS} requests in {PER_S:g} s"
        else:
            self._believed_at.append(now)
            why = self._hand.refusal(request)
        if why:
            what = f"`{request.kind}` of {request.node or 'this host'}"
            self._write_down(f"{what} for {peer}, decision {request.id}, is refused: {why}", now)
            self._refused(request, why)
        else:
            self._hand.begin(request)

    def _write_down(self, text: str, now: float) -> None:
        if _full(self._written_at, now):
            self._unwritten += 1
            return
        if self._unwritten:
            text, self._unwritten = f"{text} (and {self._unwritten} more before it that are not written here)", 0
        self._written_at.append(now)
        self._write(text)


def _full(times: deque[float], now: float) -> bool:
    return len(times) == times.maxlen and now - times[0] < PER_S
