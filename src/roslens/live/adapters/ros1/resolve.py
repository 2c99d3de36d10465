"""Addresses of hosts by their names, without waiting for a name server that does not answer."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable

FRESH_S = 60.0
AGAIN_S = 10.0
WAIT_S = 0.5
_LONGEST_NAME = 255


class UnresolvedError(OSError):
    """A host whose address is unknown; the text states the reason."""


def _ask(host: str) -> str:
    return str(socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)[0][4][0])


class Resolver:
    """Looks addresses up in threads of their own and remembers the answers.

    Slave URIs often name hosts that only some machines know, and a look-up has no time-out of its own: a name that
    takes longer than ``wait_s`` is unresolved for now, and known once the answer has come.
    """

    def __init__(
        self,
        ask: Callable[[str], str] = _ask,
        wait_s: float = WAIT_S,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._ask = ask
        self._wait_s = wait_s
        self._clock = clock
        self._lock = threading.Lock()
        self._known: dict[str, tuple[float, str, str]] = {}
        self._asked: dict[str, threading.Event] = {}

    def address(self, host: str) -> str:
        """Return the address of a host.

        Raises:
            UnresolvedError: there is none, or none was reported in time.
        """
        if not host or len(host) > _LONGEST_NAME:
            raise UnresolvedError(f"{host[:60]!r} is not a host name")
        with self._lock:
            known = self._current(host)
            done = self._asked.get(host)
            if known is None and done is None:
                done = self._asked[host] = threading.Event()
                threading.Thread(target=self._look_up, args=(host, done), daemon=True).start()
        if known is None and done is not None and done.wait(self._wait_s):
            with self._lock:
                known = self._current(host)
        if known is None:
            raise UnresolvedError(f"no name server gave the address of {host!r} within {self._wait_s:g} s")
        if not known[1]:
            raise UnresolvedError(f"the address of {host!r} is not known here: {known[2]}")
        return known[1]

    def _current(self, host: str) -> tuple[float, str, str] | None:
        known = self._known.get(host)
        if known and self._clock() - known[0] < (FRESH_S if known[1] else AGAIN_S):
            return known
        return None

    def _look_up(self, host: str, done: threading.Event) -> None:
        address, problem = "", ""
        try:
            address = self._ask(host)
        except (OSError, UnicodeError) as error:
            problem = str(error)
        with self._lock:
            self._known[host] = (self._clock(), address, problem)
            self._asked.pop(host, None)
        done.set()
