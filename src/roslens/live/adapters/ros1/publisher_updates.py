"""A slave API of our own, through which the master reports publishers of a topic that appear and vanish."""

from __future__ import annotations

import os
import socket
import threading
import xmlrpc.client
from collections.abc import Callable, Mapping
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from roslens.live.adapters.ros1.wire.xml_rpc import CallError, read_message

_LARGEST = 4_000_000
_PATIENCE_S = 5.0

Update = Callable[[str, tuple[str, ...]], None]
Answer = Callable[[list[Any]], list[Any]]


class UpdateServer:
    """Answers as a node would and passes ``publisherUpdate`` on, and ``paramUpdate`` to ``parameter_reported``.

    Args:
        address: to listen at, empty for all of this host; a port of its own is chosen.
        host: by which others reach that address.
        master_uri: given to who asks.
        reported: called with topic and URIs of all its publishers, in a thread of the server.
        more: what else is answered, by method.
    """

    def __init__(
        self, address: str, host: str, master_uri: str, reported: Update, more: Mapping[str, Answer] | None = None
    ) -> None:
        answers: dict[str, Answer] = {
            "publisherUpdate": self._updated,
            "getPid": lambda _: [1, "", os.getpid()],
            "getBusStats": lambda _: [1, "", [[], [], []]],
            "getBusInfo": lambda _: [1, "", []],
            "getMasterUri": lambda _: [1, "", master_uri],
            "getPublications": lambda _: [1, "", []],
            "getSubscriptions": lambda _: [1, "", []],
            "paramUpdate": self._parameter,
            "shutdown": lambda _: [0, "an observer is ended where it was started", 0],
            "requestTopic": lambda _: [0, "an observer publishes nothing", 0],
            **(more or {}),
        }
        self._reported = reported
        self.parameter_reported: Callable[[str, Any], None] = lambda _key, _value: None
        family = socket.AF_INET6 if ":" in address else socket.AF_INET
        server = type("Server", (ThreadingHTTPServer,), {"address_family": family, "daemon_threads": True})
        self._server: ThreadingHTTPServer = server((address, 0), _handler(answers))
        bracketed = f"[{host}]" if ":" in host else host
        self.uri = f"http://{bracketed}:{self._server.server_address[1]}/"
        self._thread = threading.Thread(
            target=self._server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True, name="publisher updates"
        )
        self._thread.start()

    def _updated(self, arguments: list[Any]) -> list[Any]:
        if len(arguments) == 3 and isinstance(arguments[1], str) and isinstance(arguments[2], list):
            self._reported(arguments[1], tuple(uri for uri in arguments[2] if isinstance(uri, str)))
            return [1, "", 0]
        return [-1, "expected caller, topic and a list of URIs", 0]

    def _parameter(self, arguments: list[Any]) -> list[Any]:
        if len(arguments) == 3 and isinstance(arguments[1], str):
            self.parameter_reported(arguments[1], arguments[2])
            return [1, "", 0]
        return [-1, "expected caller, key and value", 0]

    def close(self) -> None:
        """Stop listening."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


def answer_to(body: bytes, answers: Mapping[str, Answer]) -> bytes:
    """Return the answer to a call, which may be no call at all."""
    value: list[Any]
    try:
        arguments, method = read_message(body, "this")
        answer = answers.get(method)
        value = answer(list(arguments)) if answer else [-1, f"{method[:60]!r} is not known here", 0]
    except CallError as error:
        value = [-1, str(error)[:200], 0]
    return xmlrpc.client.dumps((value,), methodresponse=True).encode()


def _handler(answers: Mapping[str, Answer]) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"
        timeout = _PATIENCE_S

        def do_POST(self) -> None:
            length = self.headers.get("Content-Length", "")
            if not length.isdecimal() or int(length) > _LARGEST:
                self.send_error(400, "a length is expected, and a bearable one")
                return
            body = answer_to(self.rfile.read(int(length)), answers)
            self.send_response(200)
            self.send_header("Content-Type", "text/xml")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format: str, *args: Any) -> None:  # noqa: A002
            """Log nothing: standard error is for failures of our own."""

    return Handler
