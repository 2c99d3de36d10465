"""The key with which somebody who looks becomes somebody who may act, and which requests may carry it."""

from __future__ import annotations

import hmac
import secrets
import threading
import time
from collections import deque
from collections.abc import Callable
from urllib.parse import urlsplit

from starlette.requests import Request

MOST_WRONG = 6
WRONG_WITHIN_S = 60.0
_OWN = "same-origin"


class OperatorKey:
    """A key that is made with the server and lasts as long as it.

    It is too long to be guessed. Who sends wrong ones is told after six within a minute that there were too many, so
    that nobody has to write each of them down; the right one opens even then, and nobody keeps an operator out.

    Attributes:
        text: the key; tell it to nobody but the operator.
    """

    def __init__(self, steady: Callable[[], float] = time.monotonic, text: str = "") -> None:
        """Make a key, or take ``text`` for it; ``steady`` is a clock that never jumps."""
        self.text = text or secrets.token_urlsafe(24)
        self._steady = steady
        self._lock = threading.Lock()
        self._wrong: deque[float] = deque(maxlen=MOST_WRONG)

    def why_not(self, given: str) -> str:
        """Return why a key opens nothing; empty where it is the right one."""
        if given and hmac.compare_digest(given.encode("utf-8", "replace"), self.text.encode()):
            return ""
        with self._lock:
            self._wrong.append(self._steady())
        return "no key was given" if not given else "the key is not that of this server"

    def too_many(self) -> bool:
        """Whether more wrong keys came within a minute than a person types."""
        with self._lock:
            return len(self._wrong) == MOST_WRONG and self._steady() - self._wrong[0] < WRONG_WITHIN_S


def foreign(request: Request) -> str:
    """Return why a request that acts was not sent by a page of this server; empty where it was.

    Browsers say where a request comes from, and no page can make them say something else. Who says nothing is refused.
    """
    site = request.headers.get("sec-fetch-site")
    origin = request.headers.get("origin")
    if site is not None and site != _OWN:
        return f"the request comes from another site ({site[:40]!r})"
    # Where no referrer is sent, browsers write `null` for the origin of a form; of what site they say all the same.
    if origin is not None and not (origin == "null" and site == _OWN):
        told = urlsplit(origin)
        if told.netloc.lower() != request.headers.get("host", "").lower() or told.scheme != request.url.scheme:
            return f"the request comes from {origin[:80]!r}"
    if site is None and origin is None:
        return "the request does not say where it comes from (Origin)"
    return ""
