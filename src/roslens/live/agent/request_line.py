"""The agent's side of the encrypted line: connects to the monitor, gives out challenges, takes requests."""

from __future__ import annotations

import contextlib
import select
import socket
import threading
import time
from collections.abc import Callable, Iterator

import msgspec

from roslens.live.agent.enrol import AgentEnrolment
from roslens.live.agent.host_hand import Done
from roslens.live.agent.message_line import LineError, MessageReader, message
from roslens.live.agent.pinned_tls import agent_context, fingerprint, peer_fingerprint
from roslens.live.agent.request_gate import RequestGate, TooMuchError
from roslens.live.agent.signed_request import Believing
from roslens.live.agent.tls_duplex import TlsDuplex

CHALLENGE_EVERY_S = 1.0
_SHORTEST_WAIT_S, _LONGEST_WAIT_S = 0.5, 10.0
_PATIENCE_S = 5.0


class RequestLine:
    """Connects again and again from a thread of its own, until it is closed."""

    def __init__(
        self, host: str, address: tuple[str, int], enrolment: AgentEnrolment, say: Callable[[str], None],
        steady: Callable[[], float] = time.monotonic,
    ) -> None:  # fmt: skip
        """Take requests for ``host`` from the monitor at ``address``.

        Raises:
            UsageError: what was enrolled is not usable.
        """
        self._host = host
        self._address = address
        self._context = agent_context(enrolment.own, enrolment.monitor)
        self._monitor = fingerprint(enrolment.monitor)
        self._key = enrolment.key
        self._say = say
        self._steady = steady
        self._closed = threading.Event()
        self._end, self._ended = socket.socketpair()
        self._line: TlsDuplex | None = None
        self._said = ""
        self._thread = threading.Thread(target=self._run, name="requests", daemon=True)

    def start(self, gate: RequestGate) -> None:
        """Begin; requests go to ``gate``."""
        self._gate = gate
        self._thread.start()

    def tell(self, done: Done) -> None:
        """Report the result of a request to the monitor; if it is not connected, only the journal has it."""
        if (line := self._line) is not None:
            line.send(message(b"D", msgspec.msgpack.encode(done)))

    def close(self) -> None:
        """Hang up."""
        self._closed.set()
        self._end.send(b"!")
        if (line := self._line) is not None:
            line.hang_up()
        self._thread.join(_PATIENCE_S)
        self._end.close()
        self._ended.close()

    def _run(self) -> None:
        wait_s = _SHORTEST_WAIT_S
        while not self._closed.is_set():
            try:
                with self._connected() as line:
                    wait_s = _SHORTEST_WAIT_S
                    self._tell_once(f"takes requests of the monitor at {self._address[0]}:{self._address[1]}")
                    self._serve(line)
                    self._tell_once("the monitor hung up the line of requests; trying again")
            except (OSError, LineError, TooMuchError) as error:
                reason = getattr(error, "reason", None) or getattr(error, "strerror", None) or error
                self._tell_once(f"no line of requests to {self._address[0]}:{self._address[1]}: {reason}; trying again")
            # Not by the event: its timed wait has no end where the clock of this process is another one's.
            select.select([self._ended], [], [], wait_s)
            wait_s = min(2 * wait_s, _LONGEST_WAIT_S)

    @contextlib.contextmanager
    def _connected(self) -> Iterator[TlsDuplex]:
        with socket.create_connection(self._address, timeout=_PATIENCE_S) as plain:
            plain.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            with self._context.wrap_socket(plain) as line, TlsDuplex(line, _PATIENCE_S) as duplex:
                if peer_fingerprint(line) != self._monitor:
                    raise LineError("it is another monitor than the one that was enrolled")
                self._line = duplex
                try:
                    yield duplex
                finally:
                    self._line = None

    def _serve(self, line: TlsDuplex) -> None:
        believing = Believing(self._host, self._key)
        reader = MessageReader()
        due = self._steady()
        while not self._closed.is_set():
            now = self._steady()
            if now >= due:
                due = now + CHALLENGE_EVERY_S
                line.send(message(b"C", believing.challenge(now)))
            piece = line.receive(min(max(due - self._steady(), 0.0), CHALLENGE_EVERY_S))
            if piece == b"":
                return
            for letter, body in reader.feed(piece or b""):
                if letter != b"R":
                    raise LineError(f"a message {letter!r} from the monitor")
                self._gate.take(body, believing, self._steady(), self._address[0])

    def _tell_once(self, text: str) -> None:
        if text != self._said:
            self._said = text
            self._say(text)
