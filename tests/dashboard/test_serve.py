"""How the pages are served: on which socket, with which options, and how it ends."""

from __future__ import annotations

import signal
import socket
from typing import Any

import pytest
import uvicorn
from dashboard.conftest import Client
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.dashboard import server
from roslens.dashboard.patient_protocol import PatientProtocol
from roslens.dashboard.server import create_app, serve
from roslens.dashboard.site import Site
from roslens.model.errors import StoreError, UsageError


class Runs:
    """What uvicorn was given to run."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.servers: list[uvicorn.Server] = []
        self.sockets: list[socket.socket] = []
        self.ready: list[str] = []
        self.error: BaseException | None = None
        runs = self

        def run(server: uvicorn.Server, sockets: list[socket.socket]) -> None:
            runs.servers.append(server)
            runs.sockets += sockets
            assert all(one.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN) for one in sockets)
            if runs.error is not None:
                raise runs.error

        monkeypatch.setattr(uvicorn.Server, "run", run)

    @property
    def config(self) -> uvicorn.Config:
        return self.servers[0].config


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Runs:
    return Runs(monkeypatch)


def test_it_is_quiet_patient_and_of_this_machine(bare_site: Site, runs: Runs) -> None:
    serve(bare_site, port=0, ready=runs.ready.append)
    config = runs.config
    assert (config.log_level, config.access_log, config.lifespan, config.ws) == ("error", False, "off", "none")
    # What serves is nobody's business; and who keeps a connection does not keep the server from its end.
    assert config.server_header is False
    assert config.http is PatientProtocol
    assert config.timeout_graceful_shutdown == 2
    assert len(runs.sockets) == 1
    assert runs.sockets[0].fileno() == -1
    (address,) = runs.ready
    assert address.startswith("http://127.0.0.1:")
    assert address.endswith("/")


def test_the_usual_port(bare_site: Site, monkeypatch: pytest.MonkeyPatch) -> None:
    def taken(host: str, port: int, *, local: str, free: str) -> socket.socket:
        raise UsageError(f"{host} {port}", expected=local, advice=free)

    monkeypatch.setattr(server, "listen", taken)
    with pytest.raises(UsageError) as refused:
        serve(bare_site)
    found = refused.value
    assert found.what == "127.0.0.1 8080"
    assert found.expected == "Leave --host out to listen on this machine only"
    assert found.advice == "Give another one with --port, or --port 0 for any free one"


def test_ctrl_c_is_how_it_ends_and_an_error_is_one(bare_site: Site, runs: Runs) -> None:
    runs.error = KeyboardInterrupt()
    serve(bare_site, port=0)
    runs.error = RuntimeError("broken")
    with pytest.raises(RuntimeError, match="broken"):
        serve(bare_site, port=0)
    assert [one.fileno() for one in runs.sockets] == [-1, -1]


def test_it_answers_to_the_name_that_it_listens_on(bare_site: Site, runs: Runs) -> None:
    serve(bare_site, host="LocalHost", port=0)
    app: Any = runs.config.app
    assert app.user_middleware[0].kwargs == {"names": frozenset({"localhost"}), "access": None}


def test_streams_end_with_a_signal(bare_site: Site, runs: Runs, monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {}

    def create(site: Site, names: frozenset[str], **others: Any) -> None:
        given.update(others)

    monkeypatch.setattr(server, "create_app", create)
    serve(bare_site, port=0, snapshot=bytes, detail=str.encode)
    assert (given["snapshot"], given["detail"]) == (bytes, str.encode)
    assert given["stopped"]() is False
    runs.servers[0].handle_exit(signal.SIGTERM, None)
    assert given["stopped"]() is True
    assert runs.servers[0].should_exit


def test_a_store_that_fails_is_an_answer_of_its_own(bare_site: Site, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise StoreError("the disk failed <here>", expected="a disk", advice="check it")

    monkeypatch.setitem(server.PAGES, "overview", broken)
    views: list[Any] = []
    message = server.Renderer.message

    def noted(renderer: server.Renderer, view: Any, links: Any) -> str:
        views.append(view)
        return message(renderer, view, links)

    monkeypatch.setattr(server.Renderer, "message", noted)
    answer = Client(create_app(bare_site)).get("/")
    assert answer.status_code == 503
    # The error brings its own advice.
    assert views[0].shown["advice"] == ""
    assert "check it" in answer.text
    assert "The run cannot be read" in answer.text
    assert "the disk failed &lt;here&gt;" in answer.text
    assert "content-security-policy" in answer.headers


@pytest.mark.parametrize("path", ["/computation/none", "/nodes/none", "/topics/none", "/packages/none"])
@pytest.mark.parametrize("reading", ["", "The graph is being read"])
def test_what_is_still_read_is_promised_for_graphs_alone(
    bare_site: Site, monkeypatch: pytest.MonkeyPatch, path: str, reading: str
) -> None:
    monkeypatch.setattr(bare_site, "reading", reading)
    answer = Client(create_app(bare_site)).get(path)
    assert answer.status_code == 404
    assert "No such page" in answer.text
    assert f"There is nothing at {path}." in answer.text
    assert ("try again in a moment" in answer.text) is (bool(reading) and not path.startswith("/packages"))
    assert ("It may be part of another run" in answer.text) is not ("try again in a moment" in answer.text)


def test_twins_have_their_types_and_no_icon_is_none(bare_site: Site) -> None:
    client = Client(create_app(bare_site))
    assert client.get("/overview.json").headers["content-type"] == "application/json"
    assert client.get("/rules.csv").headers["content-type"] == "text/csv; charset=utf-8"
    icon = client.get("/favicon.ico")
    assert (icon.status_code, icon.text) == (404, "")
    assert client.get("/web/main.js").status_code == 200
    assert client.get("/rules/none.csv").status_code == 404


def test_the_live_page_knows_names_details_and_its_end(bare_site: Site) -> None:
    robot = ScriptedRobot()
    robot.run(3)
    app = create_app(bare_site, frozenset({"robot"}), snapshot=robot.page.newest)
    client = Client(app)
    assert client.get("/live/", headers={"host": "robot"}).status_code == 200
    refused = client.get("/live/", headers={"host": "evil.example"})
    assert refused.status_code == 421
    assert "start `roslens serve` with --host" in refused.text
