"""An address from which Prometheus reads: one page, served from a thread of its own."""

from __future__ import annotations

import socket
from collections.abc import Callable
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from urllib.parse import urlsplit

from roslens.intake.host_header import names_this_machine
from roslens.live.publish.prometheus import CONTENT_TYPE

_LONGEST_REQUEST_S = 5.0
_EXPLAIN = "The Host header has to be an address, localhost or the name of this machine."


class Endpoint:
    """Serves the text that ``page`` returns under ``/metrics``; it says so where that raises TimeoutError.

    A request under a name that is not one of this machine is refused.
    """

    def __init__(self, address: tuple[str, int], page: Callable[[], str]) -> None:
        """Listen on ``address`` (port 0 takes a free one).

        Raises:
            OSError: the address cannot be listened on.
        """
        names = frozenset({"localhost", socket.gethostname().lower()})

        class Answer(BaseHTTPRequestHandler):
            timeout = _LONGEST_REQUEST_S

            def do_GET(self) -> None:
                given = self.headers.get_all("Host", [])
                if len(given) != 1 or not names_this_machine(given[0], names):
                    self.send_error(HTTPStatus.MISDIRECTED_REQUEST, "not a name of this machine", _EXPLAIN)
                    return
                if urlsplit(self.path).path != "/metrics":
                    self.send_error(HTTPStatus.NOT_FOUND, "only /metrics is here")
                    return
                try:
                    body = page().encode("utf-8", "replace")
                except TimeoutError as error:
                    self.send_error(HTTPStatus.SERVICE_UNAVAILABLE, str(error))
                    return
                self.send_response(HTTPStatus.OK)
                self.send_header("Content-Type", CONTENT_TYPE)
                self.send_header("Content-Length", str(len(body)))
                self.end_headers()
                self.wfile.write(body)

            def log_message(self, format: str, *arguments: object) -> None:  # noqa: A002 - the library's name
                """Log nothing: Prometheus sends a request every few seconds."""

        self._server = ThreadingHTTPServer(address, Answer)
        self._server.daemon_threads = True
        self._thread = Thread(target=self._server.serve_forever, name="prometheus", daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        """Where the page is."""
        host, port = self._server.server_address[:2]
        return f"http://{host!s}:{port}/metrics"

    def close(self) -> None:
        """Serve no more."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()
