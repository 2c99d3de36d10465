"""The publishing side of TCPROS: subscribers get every message, and of a latched topic the last one at once."""

from __future__ import annotations

import selectors
import socket
import threading
import time
from collections import deque
from collections.abc import Mapping
from contextlib import suppress

import msgspec

from roslens.live.adapters.ros1.wire.tcpros import TcprosError, decode_header, encode_header

MOST_LINES = 200
MOST_WAITING = 8_000_000
"""Bytes that wait for a subscriber that does not read; of more, the oldest messages are lost for it."""
HANDSHAKE_S = 5.0
_LARGEST_HEADER = 65_536
_PIECE = 65_536
_WILDCARD = "*"


class Published(msgspec.Struct, frozen=True):
    """What is reported of a topic: the type of its messages, its sum, and the text of its definition.

    Who subscribes to a ``latched`` one later gets its last message.
    """

    type: str
    md5: str
    definition: str
    latched: bool = True


class _Line:
    """One subscriber."""

    def __init__(self, stream: socket.socket, now: float) -> None:
        self.stream = stream
        self.begun = now
        self.came = b""
        self.topic = ""
        self.waiting: deque[bytes] = deque()
        self.bytes = 0
        self.sending = memoryview(b"")

    def add(self, message: bytes) -> int:
        """Let a message wait; return how many were lost for it."""
        self.waiting.append(message)
        self.bytes += len(message)
        lost = 0
        while self.bytes > MOST_WAITING and len(self.waiting) > 1:
            self.bytes -= len(self.waiting.popleft())
            lost += 1
        return lost

    @property
    def wants(self) -> bool:
        """Whether there is something to send."""
        return bool(self.sending) or bool(self.waiting)

    def send(self) -> None:
        """Send what goes without waiting.

        Raises:
            OSError: the subscriber is gone.
        """
        with suppress(BlockingIOError):
            while self.wants:
                if not self.sending:
                    message = self.waiting.popleft()
                    self.bytes -= len(message)
                    self.sending = memoryview(message)
                self.sending = self.sending[self.stream.send(self.sending) :]


class TopicServer:
    """Serves the subscribers of some topics from a thread of its own.

    Attributes:
        port: on which it listens.
        lost: messages that were lost for a subscriber that did not read.
    """

    def __init__(self, address: str, caller: str, topics: Mapping[str, Published]) -> None:
        """Listen at ``address``, empty for all of this host, as the node ``caller``.

        Raises:
            OSError: the address cannot be listened on.
        """
        self.lost = 0
        self._caller = caller
        self._topics = topics
        self._last: dict[str, bytes] = {}
        self._asked: deque[tuple[str, bytes]] = deque(maxlen=1000)
        self._lines: dict[int, _Line] = {}
        self._closed = False
        family = socket.AF_INET6 if ":" in address else socket.AF_INET
        self._listener = socket.create_server((address, 0), family=family)
        self._listener.setblocking(False)
        self.port: int = self._listener.getsockname()[1]
        self._bell, self._rung = socket.socketpair()
        self._bell.setblocking(False)
        self._rung.setblocking(False)
        self._selector = selectors.DefaultSelector()
        for stream in (self._listener, self._rung):
            self._selector.register(stream, selectors.EVENT_READ)
        self._thread = threading.Thread(target=self._serve, name="topics", daemon=True)
        self._thread.start()

    def publish(self, topic: str, body: bytes) -> None:
        """Send a serialised message to all subscribers; returns at once."""
        self._asked.append((topic, len(body).to_bytes(4, "little") + body))
        self._ring()

    def subscribers(self, topic: str) -> int:
        """Return how many are connected to a topic."""
        return sum(line.topic == topic for line in list(self._lines.values()))

    def close(self) -> None:
        """Hang up and listen no more."""
        self._closed = True
        self._ring()
        self._thread.join()
        self._selector.close()
        for stream in (self._listener, self._bell, self._rung, *(line.stream for line in self._lines.values())):
            stream.close()

    def _ring(self) -> None:
        with suppress(BlockingIOError):
            self._bell.send(b"!")

    def _serve(self) -> None:
        while not self._closed:
            for key, events in self._selector.select(HANDSHAKE_S):
                if key.fileobj is self._listener:
                    self._accept()
                elif key.fileobj is self._rung:
                    with suppress(BlockingIOError):
                        self._rung.recv(_PIECE)
                elif key.fd in self._lines:
                    self._turn(self._lines[key.fd], events)
            while self._asked:
                self._send(*self._asked.popleft())
            self._drop_silent()

    def _accept(self) -> None:
        with suppress(OSError):
            stream, _ = self._listener.accept()
            if len(self._lines) >= MOST_LINES:
                stream.close()
                return
            stream.setblocking(False)
            with suppress(OSError):
                stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._lines[stream.fileno()] = _Line(stream, time.monotonic())
            self._selector.register(stream, selectors.EVENT_READ)

    def _turn(self, line: _Line, events: int) -> None:
        try:
            if events & selectors.EVENT_READ:
                self._read(line)
            line.send()
        except (OSError, TcprosError):
            self._drop(line)
        else:
            self._wait_for(line)

    def _read(self, line: _Line) -> None:
        with suppress(BlockingIOError):
            piece = line.stream.recv(_PIECE)
            if not piece:
                raise TcprosError("the subscriber hung up")
            if line.topic:  # who subscribes has nothing to say after its header
                return
            line.came += piece
            size = int.from_bytes(line.came[:4], "little")
            if size > _LARGEST_HEADER:
                raise TcprosError(f"a header of {size:,} bytes")
            if len(line.came) >= 4 + size >= 8:
                self._meet(line, decode_header(line.came[4 : 4 + size]))

    def _meet(self, line: _Line, header: Mapping[str, str]) -> None:
        topic = header.get("topic", "")
        problem = self._problem(topic, header)
        if problem:
            with suppress(OSError):
                line.stream.send(encode_header({"error": problem}))
            raise TcprosError(problem)
        published = self._topics[topic]
        line.topic, line.came = topic, b""
        line.add(
            encode_header(
                {
                    "callerid": self._caller,
                    "latching": "1" if published.latched else "0",
                    "md5sum": published.md5,
                    "message_definition": published.definition,
                    "topic": topic,
                    "type": published.type,
                }
            )
        )
        if published.latched and topic in self._last:
            line.add(self._last[topic])

    def _problem(self, topic: str, header: Mapping[str, str]) -> str:
        published = self._topics.get(topic)
        if published is None:
            return f"{topic[:200]!r} is not published here"
        for key, own in (("type", published.type), ("md5sum", published.md5)):
            asked = header.get(key, _WILDCARD)
            if asked not in (own, _WILDCARD):
                return f"{key} is {asked[:200]!r}, expected {own!r}"
        return ""

    def _send(self, topic: str, message: bytes) -> None:
        self._last[topic] = message
        for line in list(self._lines.values()):
            if line.topic == topic:
                self.lost += line.add(message)
                self._turn(line, 0)

    def _wait_for(self, line: _Line) -> None:
        events = selectors.EVENT_READ | (selectors.EVENT_WRITE if line.wants else 0)
        self._selector.modify(line.stream, events)

    def _drop(self, line: _Line) -> None:
        self._lines.pop(line.stream.fileno(), None)
        self._selector.unregister(line.stream)
        line.stream.close()

    def _drop_silent(self) -> None:
        end = time.monotonic() - HANDSHAKE_S
        for line in [one for one in self._lines.values() if not one.topic and one.begun < end]:
            self._drop(line)
