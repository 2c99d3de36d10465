"""Fakes: a server of scripted answers, and a whole system of a master and nodes made of such servers."""

import contextlib
import socket
import threading
import xmlrpc.client
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest


class FakeServer:
    """Answers XML-RPC calls: by a value, by what a function of the arguments returns, or by bytes as they are."""

    def __init__(self, answers=None, port=0):
        self.answers = answers if answers is not None else {}
        self.calls = []
        fake = self
        opened = []

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_POST(self):
                body = self.rfile.read(int(self.headers["Content-Length"]))
                arguments, method = xmlrpc.client.loads(body)
                fake.calls.append((method, arguments))
                answer = fake.answers.get(method, [-1, "unknown", 0])
                if callable(answer):
                    answer = answer(*arguments)
                if not isinstance(answer, bytes):
                    answer = xmlrpc.client.dumps((answer,), methodresponse=True, allow_none=True).encode()
                self.send_response(200)
                self.send_header("Content-Length", str(len(answer)))
                self.end_headers()
                self.wfile.write(answer)

            def log_message(self, *args):
                pass

        class Server(ThreadingHTTPServer):
            daemon_threads = True

            def process_request(self, request, address):
                opened.append(request)
                super().process_request(request, address)

            def handle_error(self, request, address):
                pass

        self.lines = opened
        self.server = Server(("127.0.0.1", port), Handler)
        self.port = self.server.server_address[1]
        self.uri = f"http://127.0.0.1:{self.port}/"
        self.thread = threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.01}, daemon=True)
        self.thread.start()
        self.up = True

    def hang_up(self):
        """Close the open connections, as the end of a process does, and go on listening."""
        for line in self.lines:
            with contextlib.suppress(OSError):
                line.shutdown(socket.SHUT_RDWR)

    def close(self):
        if self.up:
            self.up = False
            self.server.shutdown()
            self.server.server_close()
            self.hang_up()
            self.thread.join()


@pytest.fixture
def serve():
    servers = []

    def make(answers=None, port=0):
        servers.append(FakeServer(answers, port))
        return servers[-1]

    yield make
    for server in servers:
        server.close()


@pytest.fixture
def script():
    """Serve one connection after the other by a function of the accepted socket, in a thread."""
    opened = []

    def make(play):
        listener = socket.create_server(("127.0.0.1", 0))
        done = threading.Event()

        def run():
            while True:
                try:
                    line, _ = listener.accept()
                except OSError:
                    return
                opened.append(line)
                with contextlib.suppress(OSError):
                    play(line, done)

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        opened.append((listener, done, thread))
        return listener.getsockname()[1]

    yield make
    for item in list(opened):
        if isinstance(item, tuple):
            item[1].set()
            item[0].shutdown(socket.SHUT_RDWR)
            item[0].close()
            item[2].join(5)
    for item in opened:
        if not isinstance(item, tuple):
            item.close()


class FakeSystem:
    """A master and nodes, as far as observing them goes."""

    def __init__(self, serve):
        self._serve = serve
        self.pid = 100
        self.publishers, self.subscribers, self.services, self.types = {}, {}, {}, {}
        self.nodes = {}
        self.reported = []
        self.master = self.start()

    def start(self, port=0):
        ok = lambda value: [1, "", value]  # noqa: E731
        table = lambda part: [[name, sorted(nodes)] for name, nodes in sorted(part.items())]  # noqa: E731

        def register(caller, topic, type_, uri):
            self.reported.append(uri)
            self.subscribers.setdefault(topic, set()).add(caller)
            return ok([])

        def unregister(caller, topic, uri):
            self.subscribers[topic].discard(caller)
            return ok(1)

        def look_up(caller, node):
            return ok(self.nodes[node].uri) if node in self.nodes else [-1, f"unknown node [{node}]", ""]

        self.master = self._serve(
            {
                "getSystemState": lambda caller: ok(
                    [table(self.publishers), table(self.subscribers), table(self.services)]
                ),
                "getTopicTypes": lambda caller: ok([list(pair) for pair in self.types.items()]),
                "getPid": lambda caller: ok(self.pid),
                "lookupNode": look_up,
                "registerSubscriber": register,
                "unregisterSubscriber": unregister,
            },
            port,
        )
        return self.master

    def node(self, name, stats=((), ()), links=(), pid=1):
        listed = lambda value: [listed(part) for part in value] if isinstance(value, (list, tuple)) else value  # noqa: E731
        node = self._serve({})
        node.answers.update(
            {
                "getPid": lambda caller: [1, "", pid],
                "getBusStats": lambda caller: [1, "", [*listed(node.stats), []]],
                "getBusInfo": lambda caller: [1, "", listed(node.links)],
            }
        )
        node.stats, node.links = stats, links
        self.nodes[name] = node
        self.publishers.setdefault("/rosout", set()).add(name)
        return node

    def unregister(self, name):
        for part in (self.publishers, self.subscribers, self.services):
            for nodes in part.values():
                nodes.discard(name)
        del self.nodes[name]


@pytest.fixture
def system(serve):
    return FakeSystem(serve)
