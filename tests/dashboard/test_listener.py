"""The socket of the pages: where it listens, how its address is written, and what is said where it cannot."""

from __future__ import annotations

import socket
from contextlib import closing
from typing import Any

import pytest

from roslens.dashboard.listener import address_shown, listen
from roslens.model.errors import UsageError


def opened(host: str, port: int = 0) -> socket.socket:
    return listen(host, port, local="stay here", free="take another")


def test_a_free_port_is_taken_and_accepts_connections() -> None:
    with closing(opened("127.0.0.1")) as listener:
        host, port = listener.getsockname()
        assert address_shown(listener) == f"http://127.0.0.1:{port}/"
        assert (listener.type, listener.family) == (socket.SOCK_STREAM, socket.AF_INET)
        # Otherwise a server that has just ended keeps its port for a minute.
        assert listener.getsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR) == 1
        with socket.create_connection((host, port), timeout=5):
            pass


def test_an_address_of_colons_is_shown_in_brackets() -> None:
    class Listener:
        def getsockname(self) -> tuple[str, int, int, int]:
            return "::1", 8080, 0, 0

    listener: Any = Listener()
    assert address_shown(listener) == "http://[::1]:8080/"


def test_the_largest_port_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    bound: list[tuple[str, int]] = []

    class Socket:
        def __init__(self, *_: object) -> None:
            self.setsockopt = self.listen = lambda *_: None

        def bind(self, address: tuple[str, int]) -> None:
            bound.append(address)

    monkeypatch.setattr("roslens.dashboard.listener.socket.socket", Socket)
    opened("127.0.0.1", 65535)
    assert bound == [("127.0.0.1", 65535)]


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_number_beyond_the_ports_is_refused(port: int) -> None:
    with pytest.raises(UsageError) as refused:
        opened("127.0.0.1", port)
    assert str(refused.value.what) == f"port {port}"
    assert refused.value.expected == "a number from 0 to 65535"


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (socket.gaierror(-2, "Name or service not known"), "Name or service not known"),
        (OSError("no words of the system"), "no words of the system"),
        (UnicodeError("label too long"), "label too long"),
    ],
)
def test_a_host_of_nowhere_is_refused_with_the_reason(
    monkeypatch: pytest.MonkeyPatch, error: Exception, reason: str
) -> None:
    def unknown(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    with pytest.raises(UsageError) as refused:
        opened("nowhere")
    found = refused.value
    assert (found.what, found.expected, found.advice) == (
        f"cannot listen on 'nowhere': {reason}", "a name or address of this machine", "stay here",
    )  # fmt: skip
    assert found.__cause__ is error


def test_a_taken_port_is_named_and_nothing_stays_open(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[socket.socket] = []

    class Kept(socket.socket):
        def __init__(self, *given: Any) -> None:
            super().__init__(*given)
            made.append(self)

    with closing(socket.create_server(("127.0.0.1", 0))) as taken:
        port = taken.getsockname()[1]
        monkeypatch.setattr("roslens.dashboard.listener.socket.socket", Kept)
        with pytest.raises(UsageError) as refused:
            opened("127.0.0.1", port)
    found = refused.value
    assert (found.what, found.expected, found.advice) == (
        f"cannot listen on 127.0.0.1:{port}: Address already in use", "a free port", "take another",
    )  # fmt: skip
    assert [one.fileno() for one in made] == [-1]
