"""Subscribes to topics of ROS 1 that match patterns, and passes on their messages as bytes."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from urllib.parse import urlsplit

from roslens.judge.patterns.pattern import Pattern
from roslens.live.act.keeping import Topic
from roslens.live.act.ros import ActionError
from roslens.live.adapters.ros1.master import Master
from roslens.live.adapters.ros1.names import is_observer
from roslens.live.adapters.ros1.resolve import Resolver, UnresolvedError
from roslens.live.adapters.ros1.wire.tcpros import LARGEST_HEADER, TcprosError, decode_header, encode_header
from roslens.live.adapters.ros1.wire.xml_rpc import Caller, CallError, unwrap

LOOK_S = 1.0
_PATIENCE_S = 2.0
_MOST_LINES = 200
_LARGEST = 64_000_000


class PatternSubscriber:
    """Connects to every publisher of a topic that matches; each line has a thread of its own."""

    def __init__(
        self, master_uri: str, caller: str, resolver: Resolver, patterns: Sequence[str],
        received: Callable[[Topic, bytes], None],
    ) -> None:  # fmt: skip
        """Subscribe to topics that a pattern matches.

        Raises:
            ActionError: a pattern is not valid.
        """
        try:
            self._patterns = [Pattern.parse(one) for one in patterns]
        except ValueError as error:
            raise ActionError(str(error), expected="patterns of topics") from None
        self._uri = master_uri
        self._caller = caller
        self._resolver = resolver
        self._received = received
        self._lock = threading.Lock()
        self._open: set[tuple[str, str]] = set()
        self._closed = threading.Event()
        threading.Thread(target=self._run, name="pattern_subscriber", daemon=True).start()

    def close(self) -> None:
        """Close all connections."""
        self._closed.set()

    def _run(self) -> None:
        master = Master(self._uri, self._caller, self._resolver, _PATIENCE_S)
        while not self._closed.is_set():
            with suppress(CallError):
                self._look(master)
            self._closed.wait(LOOK_S)
        master.close()

    def _look(self, master: Master) -> None:
        for topic, node in master.state()[0].publishers:
            key = (topic, node)
            with self._lock:
                known = key in self._open or len(self._open) >= _MOST_LINES
            if known or is_observer(node) or not any(one.matches(topic) for one in self._patterns):
                continue
            with suppress(CallError):
                uri = master.home(node, fresh=True)
                with self._lock:
                    self._open.add(key)
                threading.Thread(target=self._hear, args=(topic, node, uri), name="subscriber", daemon=True).start()

    def _hear(self, topic: str, node: str, uri: str) -> None:
        try:
            line = self._connected(topic, uri)
            with line:
                self._messages(line, topic, node)
        except (OSError, CallError, TcprosError, UnresolvedError):
            pass  # the next look tries again, where it is still registered
        finally:
            with self._lock:
                self._open.discard((topic, node))

    def _connected(self, topic: str, uri: str) -> socket.socket:
        api = Caller(uri, self._resolver, _PATIENCE_S)
        try:
            answer = unwrap(api.call("requestTopic", self._caller, topic, [["TCPROS"]]), "requestTopic")
        finally:
            api.close()
        if not isinstance(answer, list) or len(answer) != 3 or answer[0] != "TCPROS" or not isinstance(answer[2], int):
            raise TcprosError(f"requestTopic answers {str(answer)[:80]}")
        host = str(answer[1]) or urlsplit(uri).hostname or ""
        line = socket.create_connection((self._resolver.address(host), answer[2]), timeout=_PATIENCE_S)
        fields = {"callerid": self._caller, "topic": topic, "type": "*", "md5sum": "*", "message_definition": ""}
        line.sendall(encode_header({**fields, "tcp_nodelay": "1"}))
        return line

    def _messages(self, line: socket.socket, topic: str, node: str) -> None:
        header = decode_header(self._part(line, LARGEST_HEADER))
        if "error" in header:
            raise TcprosError(header["error"][:200])
        more = (("callerid", node), ("md5sum", header.get("md5sum", "")), ("latching", header.get("latching", "0")))
        known = Topic(topic, header.get("type", ""), "ros1msg", header.get("message_definition", ""), "ros1", more)
        while not self._closed.is_set():
            self._received(known, self._part(line, _LARGEST))

    def _part(self, line: socket.socket, largest: int) -> bytes:
        size = int.from_bytes(self._exactly(line, 4), "little")
        if size > largest:
            raise TcprosError(f"{size:,} bytes at once")
        return self._exactly(line, size)

    def _exactly(self, line: socket.socket, size: int) -> bytes:
        came = bytearray()
        while len(came) < size:
            try:
                piece = line.recv(min(size - len(came), 1 << 18))
            except TimeoutError:
                if self._closed.is_set():
                    raise TcprosError("closed") from None
                continue
            if not piece:
                raise TcprosError("the publisher hung up")
            came += piece
        return bytes(came)
