"""HTTP for whoever asks and reads, and not for whoever holds a connection: the slow and the surplus are hung up on."""

from __future__ import annotations

import asyncio
from typing import Any, ClassVar

from uvicorn.protocols.http.h11_impl import H11Protocol

MOST_CONNECTIONS = 256
"""At a time."""

MOST_OF_A_PEER = 64
"""From one address; a browser opens six, and one more for each live page."""

REQUEST_S = 10.0
"""From the connection, or the last answer, to the end of the head of a request."""

READING_S = 30.0
"""For which a reader may take nothing of an answer that waits for it."""


class PatientProtocol(H11Protocol):
    """One connection; where there are too many, the one that has waited longest without asking makes room."""

    most: ClassVar[int] = MOST_CONNECTIONS
    most_of_a_peer: ClassVar[int] = MOST_OF_A_PEER
    request_s: ClassVar[float] = REQUEST_S
    reading_s: ClassVar[float] = READING_S

    def __init__(self, *given: Any, **named: Any) -> None:
        """Take what uvicorn gives."""
        super().__init__(*given, **named)
        self._asking: asyncio.TimerHandle | None = None
        self._reading: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Let it in where there is room, or where room can be made."""
        super().connection_made(transport)
        others = [one for one in self.connections if isinstance(one, PatientProtocol) and one is not self]
        of_peer = [one for one in others if one.peer == self.peer]
        crowd = of_peer if len(of_peer) >= self.most_of_a_peer else others if len(others) >= self.most else []
        if crowd:
            idle = [one for one in crowd if one._asking is not None]  # noqa: SLF001 - of this class
            if not idle:
                self._hang_up()
                return
            min(idle, key=lambda one: one._asking.when() if one._asking else 0.0)._hang_up()  # noqa: SLF001
        self._wait_for_request()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing more."""
        self._stop_waiting()
        super().connection_lost(exc)

    def handle_events(self) -> None:
        """Stop waiting once a request is there."""
        super().handle_events()
        if self.cycle is not None and not self.cycle.response_complete and self._asking is not None:
            self._asking.cancel()
            self._asking = None

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        super().on_response_complete()
        if not self.transport.is_closing() and (self.cycle is None or self.cycle.response_complete):
            self._wait_for_request()

    def pause_writing(self) -> None:
        """The reader takes less than is written: it has a while to go on."""
        super().pause_writing()
        self._reading = self._reading or self.loop.call_later(self.reading_s, self._hang_up)

    def resume_writing(self) -> None:
        """It went on."""
        super().resume_writing()
        if self._reading is not None:
            self._reading.cancel()
            self._reading = None

    @property
    def peer(self) -> str:
        """The address at the other end; empty where there is none."""
        return self.client[0] if self.client else ""

    def _wait_for_request(self) -> None:
        if self._asking is None:
            self._asking = self.loop.call_later(self.request_s, self._hang_up)

    def _stop_waiting(self) -> None:
        for timer in (self._asking, self._reading):
            if timer is not None:
                timer.cancel()
        self._asking = self._reading = None

    def _hang_up(self) -> None:
        self._stop_waiting()
        self.connections.discard(self)
        self.transport.abort()
