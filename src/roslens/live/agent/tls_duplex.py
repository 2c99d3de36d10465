"""An encrypted line for which any thread may have something to send, and one thread alone reads and writes.

OpenSSL does not let two threads use a connection at once.
"""

from __future__ import annotations

import contextlib
import select
import socket
import ssl
from collections import deque

_PIECE = 65_536
_MOST_WAITING = 1_000


class TlsDuplex:
    """Wraps a line whose handshake is done; a context manager that lets the bell go, not the line."""

    def __init__(self, line: ssl.SSLSocket, patience_s: float) -> None:
        """Read and write ``line``; a peer that does not read for ``patience_s`` is gone."""
        self._line = line
        self._patience_s = patience_s
        self._waiting: deque[bytes] = deque(maxlen=_MOST_WAITING)
        self._bell, self._rung = socket.socketpair()
        self._bell.setblocking(False)
        self._rung.setblocking(False)
        self._closed = False

    def __enter__(self) -> TlsDuplex:
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Let the bell go."""
        self._closed = True
        self._bell.close()
        self._rung.close()

    def send(self, content: bytes) -> None:
        """Have something sent; for any thread, and returns at once."""
        self._waiting.append(content)
        self._ring()

    def hang_up(self) -> None:
        """Have :meth:`receive` report the end of the connection; for any thread."""
        self._closed = True
        self._ring()

    def receive(self, within_s: float) -> bytes | None:
        """Send what waits, and return what came within a time; None where nothing did, empty at the end of the line.

        Raises:
            OSError: the line broke.
        """
        if self._closed:
            return b""
        self._send_waiting()
        if not self._line.pending():
            ready, _, _ = select.select([self._line, self._rung], [], [], within_s)
            if self._rung in ready:
                with contextlib.suppress(BlockingIOError):
                    self._rung.recv(_PIECE)
                self._send_waiting()
            if self._line not in ready:
                return b"" if self._closed else None
        # What came may be of TLS itself, with nothing for us in it.
        self._line.settimeout(0)
        try:
            return self._line.recv(_PIECE)
        except (ssl.SSLWantReadError, ssl.SSLWantWriteError):
            return None
        except ssl.SSLZeroReturnError:
            return b""

    def _send_waiting(self) -> None:
        self._line.settimeout(self._patience_s)
        while self._waiting:
            self._line.sendall(self._waiting.popleft())

    def _ring(self) -> None:
        with contextlib.suppress(OSError):
            self._bell.send(b"!")
