"""A forge on this machine that gives recorded answers, in turn, and remembers what it was asked."""

import json
import threading
from collections import defaultdict, deque
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import unquote


class LocalForge:
    """``answers`` maps a path with its query to answers, each (status, headers, body); the last one stays."""

    def __init__(self, url: str) -> None:
        self.url = url
        self.answers: dict[str, deque] = defaultdict(deque)
        self.asked: list[tuple[str, dict[str, str]]] = []

    def add(self, path: str, body, status: int = 200, **headers: str) -> None:
        content = body if isinstance(body, bytes) else json.dumps(body).encode()
        self.answers[path].append((status, {name.replace("_", "-"): one for name, one in headers.items()}, content))

    def paths(self) -> list[str]:
        return [path for path, _ in self.asked]


@contextmanager
def local_forge():
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            path = unquote(self.path).replace("+", " ")
            forge.asked.append((path, {name.lower(): value for name, value in self.headers.items()}))
            known = forge.answers.get(path)
            status, headers, body = (404, {}, b"{}") if not known else known.popleft() if len(known) > 1 else known[0]
            if "etag" in headers and self.headers.get("If-None-Match") == headers["etag"]:
                status, body = 304, b""
            self.send_response(status)
            for name, value in headers.items():
                self.send_header(name, value)
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, *_: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    forge = LocalForge(f"http://127.0.0.1:{server.server_port}")
    thread = threading.Thread(target=server.serve_forever, args=(0.02,), daemon=True)
    thread.start()
    try:
        yield forge
    finally:
        server.shutdown()
        server.server_close()
        thread.join()
