"""The monitor's side of the encrypted lines: agents that were enrolled, and what they are asked."""

from __future__ import annotations

import queue
import socket
import threading
import time
from collections.abc import Callable

import msgspec

from roslens.live.agent.enrol import MonitorEnrolment
from roslens.live.agent.host_hand import Done
from roslens.live.agent.message_line import LineError, MessageReader, message
from roslens.live.agent.pinned_tls import fingerprint, monitor_context, peer_fingerprint
from roslens.live.agent.signed_request import (
    CHALLENGE_BYTES,
    FRESH_S,
    VERSION,
    RefusedError,
    Signed,
    sign,
)
from roslens.live.agent.tls_duplex import TlsDuplex
from roslens.live.react.actor import CarriedOut
from roslens.model.acting.host_request import HostRequest

_MOST_LINES = 64
_PATIENCE_S = 5.0
_SILENT_S = 10.0
_LOOK_S = 1.0
_MOST_TEXT = 2_000


class _Agent:
    """A line to one agent."""

    def __init__(self, host: str, line: TlsDuplex) -> None:
        self.host = host
        self.line = line
        self.challenge = b""
        self.challenged = float("-inf")
        self.number = 0
        self.under_way: set[str] = set()
        self.lock = threading.Lock()


class FarAgents:
    """Accepts agents that were enrolled, and asks them. A thread for each; the latest line of a host counts."""

    def __init__(
        self, address: tuple[str, int], enrolment: MonitorEnrolment, say: Callable[[str], None],
        steady: Callable[[], float] = time.monotonic,
    ) -> None:  # fmt: skip
        """Listen on ``address``; port 0 takes a free one.

        Raises:
            UsageError: what was enrolled is not usable.
            OSError: the address cannot be listened on.
        """
        self._context = monitor_context(enrolment.own, enrolment.certificates)
        self._hosts = {fingerprint(one): host for host, one in enrolment.certificates.items()}
        self._keys = enrolment.keys
        self._say = say
        self._steady = steady
        self._agents: dict[str, _Agent] = {}
        self._lock = threading.Lock()
        self._came: queue.SimpleQueue[CarriedOut] = queue.SimpleQueue()
        self._closed = threading.Event()
        self._lines = threading.Semaphore(_MOST_LINES)
        self._socket = socket.create_server(address)
        self._socket.settimeout(0.5)
        self.port: int = self._socket.getsockname()[1]
        threading.Thread(target=self._accept, name="agents", daemon=True).start()

    def hosts(self) -> tuple[str, ...]:
        """Return the hosts whose agents take requests now, sorted."""
        with self._lock:
            return tuple(sorted(self._agents))

    def ask(self, host: str, request: HostRequest) -> str:
        """Ask a host; return why that cannot be, empty where it is asked."""
        with self._lock:
            agent = self._agents.get(host)
        if agent is None:
            known = "is not connected" if host in self._keys else "was never enrolled: see `roslens agent --enrol`"
            return f"the agent of {host} {known}"
        with agent.lock:
            if self._steady() - agent.challenged > FRESH_S / 2:
                return f"the agent of {host} has given no challenge for {FRESH_S / 2:g} s"
            agent.number += 1
            try:
                signed = sign(Signed(VERSION, host, agent.challenge, agent.number, request), self._keys[host])
            except (RefusedError, TypeError) as error:
                return str(error)
            agent.under_way.add(request.id)
            agent.line.send(message(b"R", signed))
        return ""

    def poll(self) -> list[CarriedOut]:
        """Return what became of requests since the last time."""
        found = []
        while True:
            try:
                found.append(self._came.get_nowait())
            except queue.Empty:
                return found

    def close(self) -> None:
        """Hang up on all and listen no more."""
        self._closed.set()
        self._socket.close()
        with self._lock:
            agents = list(self._agents.values())
        for one in agents:
            one.line.hang_up()

    def _accept(self) -> None:
        while not self._closed.is_set():
            try:
                accepted, peer = self._socket.accept()
            except TimeoutError:
                continue
            except OSError:
                if not self._closed.wait(0.5):
                    continue
                return
            if not self._lines.acquire(blocking=False):
                accepted.close()
                continue
            threading.Thread(target=self._meet, args=(accepted, peer[0]), name="agent", daemon=True).start()

    def _meet(self, accepted: socket.socket, peer: str) -> None:
        try:
            with accepted:
                accepted.settimeout(_PATIENCE_S)
                accepted.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                with self._context.wrap_socket(accepted, server_side=True) as line:
                    host = self._hosts.get(peer_fingerprint(line))
                    if host is not None:
                        with TlsDuplex(line, _PATIENCE_S) as duplex:
                            self._serve(_Agent(host, duplex))
        except (OSError, LineError) as error:
            reason = getattr(error, "reason", None) or getattr(error, "strerror", None) or error
            if not self._closed.is_set():
                self._say(f"the line of requests from {peer} ended: {reason}")
        finally:
            self._lines.release()

    def _serve(self, agent: _Agent) -> None:
        with self._lock:
            before = self._agents.get(agent.host)
            self._agents[agent.host] = agent
        if before is not None:
            before.line.hang_up()
        reader = MessageReader()
        try:
            last_received = self._steady()
            while not self._closed.is_set() and (piece := agent.line.receive(_LOOK_S)) != b"":
                now = self._steady()
                last_received = now if piece else last_received
                if now - last_received > _SILENT_S:
                    raise LineError(f"the agent of {agent.host} has sent nothing for {_SILENT_S:g} s")
                for letter, body in reader.feed(piece or b""):
                    self._take(agent, letter, body)
        finally:
            with self._lock:
                if self._agents.get(agent.host) is agent:
                    del self._agents[agent.host]
            for decision in agent.under_way:
                text = f"the line to the agent of {agent.host} broke: it is unknown whether the action was done"
                self._came.put(CarriedOut(decision, False, text))

    def _take(self, agent: _Agent, letter: bytes, body: bytes) -> None:
        if letter == b"C" and len(body) == CHALLENGE_BYTES:
            with agent.lock:
                agent.challenge, agent.challenged = body, self._steady()
        elif letter == b"D":
            try:
                done = msgspec.msgpack.decode(body, type=Done)
            except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
                raise LineError(f"a malformed answer: {error}") from None
            with agent.lock:
                asked = done.id in agent.under_way
                agent.under_way.discard(done.id)
            if asked:
                text = f"{agent.host}: {done.text[:_MOST_TEXT]}"
                self._came.put(CarriedOut(done.id, done.done, text, done.duration_s, done.refused))
        else:
            raise LineError(f"a message {letter!r} of {len(body)} bytes")
