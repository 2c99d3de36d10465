"""The line to an agent is cut: nobody knows what goes on behind it, and nothing there is called dead."""

from __future__ import annotations

import socket
import threading
from contextlib import suppress

from wrong_ok.mistakes import unless
from wrong_ok.scene import Scene, free_port

BEATS_PER_S = 10
CUTS_S = (0.5, 2.0, 10.0)


class Relay:
    """Passes on what comes to a port of this host, until it is cut: then it keeps everything to itself."""

    def __init__(self, port: int) -> None:
        self._to = port
        self._server = socket.create_server(("127.0.0.1", 0))
        self.port = self._server.getsockname()[1]
        self._flows = threading.Event()
        self._flows.set()
        self._ended = False
        self._sockets: list[socket.socket] = []
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self) -> None:
        """Pass on nothing more."""
        self._flows.clear()

    def join(self) -> None:
        """Pass on what was kept, and what comes."""
        self._flows.set()

    def close(self) -> None:
        """End all connections."""
        self._ended = True
        self._flows.set()
        for one in (self._server, *self._sockets):
            with suppress(OSError):
                one.shutdown(socket.SHUT_RDWR)
            one.close()

    def _accept(self) -> None:
        with suppress(OSError):
            while not self._ended:
                near, _ = self._server.accept()
                self._sockets.append(near)
                try:
                    far = socket.create_connection(("127.0.0.1", self._to))
                except ConnectionRefusedError:
                    near.close()
                    continue
                self._sockets.append(far)
                for source, sink in ((near, far), (far, near)):
                    threading.Thread(target=self._pass, args=(source, sink), daemon=True).start()

    def _pass(self, source: socket.socket, sink: socket.socket) -> None:
        with suppress(OSError):
            while data := source.recv(1 << 16):
                self._flows.wait()
                sink.sendall(data)
            sink.shutdown(socket.SHUT_WR)


def cut_line(scene: Scene) -> list[str]:
    """The line to an agent is cut for 0.5, 2 and 10 s."""
    driver = scene.node("beats", "driver", "/beat", str(BEATS_PER_S))
    port, key = free_port(), scene.key()
    watch = scene.watch(
        "constraints:\n"
        "  - {host: arm, expected: always, memory_share: <= 100 %}\n"
        "  - {node: /driver, expected: always}\n"
        "  - {topic: /beat, rate: 5..15 Hz}\n",
        "--listen", f"127.0.0.1:{port}", "--key-file", key,
    )  # fmt: skip
    relay = Relay(port)
    try:
        scene.agent(relay.port, key, "arm")
        judged = [
            ("host:arm", "presence"),
            ("host:arm", "memory_share"),
            ("node:/driver", "presence"),
            ("topic:/beat", "rate"),
        ]
        began = watch.comes_to(*((*one, "ok") for one in judged))
        for seconds in CUTS_S:
            relay.cut()
            driver.says("sent", round(seconds * BEATS_PER_S))
            relay.join()
        noticed = watch.until(lambda line: line.get("entity") == "observer:arm/agent" and line["state"] == "unknown")
        again = watch.comes_to(*((*one, "ok") for one in judged))
    finally:
        relay.close()
    bad = {one: set(watch.states(*one)) - {"ok", "unknown"} for one in judged}
    return [
        *unless(began, "what is behind the line was never ok"),
        *unless(noticed, "a line that was cut for 10 s was not told"),
        *unless(again, "what is behind the line was not ok again"),
        *(f"{what} of {entity} was called {sorted(states)}" for (entity, what), states in bad.items() if states),
    ]
