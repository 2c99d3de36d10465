"""Who holds connections without asking, asks slowly or does not read keeps nobody else from the pages."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, suppress

import pytest
import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from roslens.dashboard.listener import listen
from roslens.dashboard.patient_protocol import PatientProtocol

pytestmark = pytest.mark.timed

REQUEST = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"


class Hasty(PatientProtocol):
    most = 12
    most_of_a_peer = 8
    request_s = 0.3
    reading_s = 0.3


async def answer(request: Request) -> Response:
    return PlainTextResponse("x" * int(request.query_params.get("size", 2)))


@pytest.fixture
def port() -> Iterator[int]:
    listener = listen("127.0.0.1", 0, local="", free="")
    app = Starlette(routes=[Route("/", answer)])
    config = uvicorn.Config(app, log_level="error", access_log=False, lifespan="off", ws="none", http=Hasty)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, args=([listener],), daemon=True)
    thread.start()
    yield listener.getsockname()[1]
    server.should_exit = True
    thread.join(20)
    listener.close()


def connect(port: int, from_: str = "127.0.0.1") -> socket.socket:
    return socket.create_connection(("127.0.0.1", port), timeout=20, source_address=(from_, 0))


def asked(port: int, from_: str = "127.0.0.1") -> bytes:
    with closing(connect(port, from_)) as line:
        line.sendall(REQUEST)
        return line.recv(1000)


def test_idle_connections_make_room_for_who_asks(port: int):
    with ExitStack() as held:
        idle = [held.enter_context(closing(connect(port))) for _ in range(40)]
        assert asked(port).startswith(b"HTTP/1.1 200")
        assert asked(port, "127.0.0.2").startswith(b"HTTP/1.1 200")
        idle[0].settimeout(20)
        assert hung_up(idle[0]), "the oldest went first"


def test_from_many_addresses_too(port: int):
    with ExitStack() as held:
        for number in range(40):
            held.enter_context(closing(connect(port, f"127.0.1.{number + 1}")))
        assert asked(port).startswith(b"HTTP/1.1 200")


def test_a_request_that_comes_letter_by_letter_is_not_waited_for(port: int):
    with closing(connect(port)) as line:
        begun = time.monotonic()
        line.settimeout(0.02)
        while time.monotonic() - begun < 20:
            try:
                line.send(b"G")
                if not line.recv(1):
                    break
            except TimeoutError:
                continue
            except OSError:
                break
        assert time.monotonic() - begun < 10


def test_an_answer_that_is_not_read_is_not_kept(port: int):
    with closing(socket.socket()) as line:
        line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        line.settimeout(20)
        line.connect(("127.0.0.1", port))
        line.sendall(REQUEST.replace(b"/ ", b"/?size=20000000 "))
        time.sleep(1)
        got = 0
        with suppress(ConnectionResetError):
            while piece := line.recv(1 << 20):
                got += len(piece)
        assert got < 20_000_000


def test_who_reads_slowly_but_reads_gets_it_all_and_may_ask_again(port: int):
    with closing(connect(port)) as line:
        for _ in range(2):
            line.sendall(REQUEST.replace(b"/ ", b"/?size=3000000 "))
            got = 0
            while got < 3_000_000:
                piece = line.recv(1 << 18)
                assert piece, f"hung up after {got:,} bytes"
                got += len(piece)
                time.sleep(0.01)


def hung_up(line: socket.socket) -> bool:
    try:
        return not line.recv(1)
    except ConnectionResetError:
        return True
