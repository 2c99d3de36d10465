"""The line from a monitor to an observer that publishes for it: bounded, and it never makes the monitor wait."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import IO

MOST_WAITING = 16_000_000
"""Bytes that wait for an observer that does not read; of more, the oldest are lost."""
LONGEST_WAIT_S = 10.0
"""Older data is not sent: an observer that was delayed continues with current data."""


class Downlink:
    """Frames for one process, written to its standard input by a thread of their own.

    Attributes:
        lost: frames that were not written, because nobody read them in time or the process ended; those before the
            first one began do not count.
    """

    def __init__(self, most_waiting: int = MOST_WAITING, steady: Callable[[], float] = time.monotonic) -> None:
        """Keep at most so many bytes of frames that wait; ``steady`` is a clock that never jumps."""
        self.lost = 0
        self._most = most_waiting
        self._steady = steady
        self._waiting: deque[tuple[float, bytes]] = deque()
        self._bytes = 0
        self._turn = threading.Condition()
        self._stream: IO[bytes] | None = None
        self._ever = False

    def attach(self, stream: IO[bytes]) -> None:
        """Write to ``stream`` from now on, which is closed when it is let go."""
        self.detach()
        with self._turn:
            self._stream = stream
            self._ever = True
        threading.Thread(target=self._write, args=(stream,), name="downlink", daemon=True).start()

    def detach(self) -> None:
        """Let the stream go; what waits for it is lost."""
        with self._turn:
            self._stream = None
            self.lost += len(self._waiting)
            self._waiting.clear()
            self._bytes = 0
            self._turn.notify_all()

    def say(self, frame: bytes) -> None:
        """Hand a frame over; returns at once."""
        with self._turn:
            if self._stream is None:
                self.lost += self._ever
                return
            now = self._steady()
            self._waiting.append((now, frame))
            self._bytes += len(frame)
            while self._bytes > self._most or self._waiting[0][0] < now - LONGEST_WAIT_S:
                self._bytes -= len(self._waiting.popleft()[1])
                self.lost += 1
                if not self._waiting:
                    return
            self._turn.notify_all()

    def _write(self, stream: IO[bytes]) -> None:
        try:
            while (frame := self._next(stream)) is not None:
                left = memoryview(frame)
                while left:
                    left = left[stream.write(left) :]
                stream.flush()
        except (OSError, ValueError):
            with self._turn:
                self.lost += 1
                if self._stream is stream:
                    self._stream = None
        finally:
            # What is left in its buffer cannot be delivered.
            with suppress(OSError, ValueError):
                stream.close()

    def _next(self, stream: IO[bytes]) -> bytes | None:
        with self._turn:
            self._turn.wait_for(lambda: self._waiting or self._stream is not stream)
            if self._stream is not stream:
                return None
            frame = self._waiting.popleft()[1]
            self._bytes -= len(frame)
            return frame
