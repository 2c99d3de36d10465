"""A text that others ask for while something changes: made between two steps, by the thread that makes the changes."""

from __future__ import annotations

from collections.abc import Callable
from queue import Empty, SimpleQueue

PATIENCE_S = 5.0


class BetweenSteps:
    """Makes a text for other threads.

    ``text`` waits in the thread that asks; ``answer`` is called in the one that changes what the text is about, as
    often as it can.
    """

    def __init__(self, make: Callable[[], str], *, patience_s: float = PATIENCE_S) -> None:
        """Make the text by ``make``; who asks waits for ``patience_s`` seconds at most."""
        self._make = make
        self._patience_s = patience_s
        self._asking: SimpleQueue[SimpleQueue[str]] = SimpleQueue()

    def text(self) -> str:
        """Return the text as it is now.

        Raises:
            TimeoutError: nobody answered in time.
        """
        reply: SimpleQueue[str] = SimpleQueue()
        self._asking.put(reply)
        try:
            return reply.get(timeout=self._patience_s)
        except Empty:
            raise TimeoutError(f"no answer for {self._patience_s:g} s: what was asked is busy or has ended") from None

    def answer(self) -> None:
        """Answer all requests with one text; without requests it costs next to nothing."""
        text = None
        while True:
            try:
                reply = self._asking.get_nowait()
            except Empty:
                return
            if text is None:
                text = self._make()
            reply.put(text)
