"""One site with every screen there is: a made-up run, a robot that runs, its past, a plan, a journal and a question."""

from __future__ import annotations

import importlib.util
import threading
from pathlib import Path
from typing import Any
from urllib.parse import quote

import msgspec
import uvicorn
from dashboard.journal.test_journal_pages import decision
from dashboard.live.scripted_robot import REFERENCE, ScriptedRobot

from roslens.cli.conformance.shown_sides import against
from roslens.cli.served.reviewing import Reviewing
from roslens.compare.conformance.observed import running_side
from roslens.dashboard.access.person import Person, Role
from roslens.dashboard.access.policy import Access
from roslens.dashboard.journal.journal_view import JournalView
from roslens.dashboard.journal.questions import Questions
from roslens.dashboard.journal.routes import journal_links, journal_routes
from roslens.dashboard.listener import Tls
from roslens.dashboard.live.further import Further
from roslens.dashboard.server import create_app
from roslens.model.graph import Graph, Node
from roslens.store.journals.journal import Journal
from roslens.store.runs import StoredRun

KEY, VIEW_KEY = "k" * 32, "v" * 32
FAKE_RUN = Path(__file__).parents[1] / "dashboard" / "fake_run.py"
REACTIONS = """
reactions:
  - id: lidar
    when: {node: /lidar, is: [gone, stopped]}
    cool_down: 10 s
    text: "{entity} is started again"
    do:
      - notify: "{entity} is gone"
      - restart: {node: /lidar}
        verify: 15 s
"""
SCREENS = (
    "/", "/graph", "/computation/rover", "/computation/rover?topics=lines", "/nodes/rover/lidar",
    "/topics/rover/topic/scan", "/packages", "/packages/nav2_util", "/files/nav2_core/src/footprint_configure_1.cpp",
    "/findings", "/findings?group=function", "/runs", "/conformance", "/metrics", "/metrics/loc", "/rules",
    "/rules/cpp.explicit_constructor", "/failures", "/search?q=rover", "/help",
    "/live/", "/live/?select=host:rover", "/live/?at=8", "/live/references", "/live/compared?from=8&to=20",
    "/plan", "/journal", "/questions",
)  # fmt: skip


class WholeSite:
    """Serves until it is closed; what a test changes on ``robot``, ``journal`` and ``questions`` is shown."""

    def __init__(self, folder: Path, tls: Tls | None = None, robot: ScriptedRobot | None = None) -> None:
        self.accepted = folder / "roslens.accepted.toml"
        self.journal = folder / "journal.jsonl"
        self.questions = Questions()
        self.robot = robot or ScriptedRobot(reference=REFERENCE + REACTIONS)
        self.robot.rates["/scan"] = 4
        self.robot.run(15)
        one = decision()
        self.questions.ask(one, one.at_s + 60.0)
        with Journal(self.journal) as journal:
            journal.add("decided", 100.0, decision="rover.lidar/1.1", entity="node:/lidar", action={"kind": "restart"})
            journal.add("done", 101.0, decision="rover.lidar/1.1", result="failed", text="no allow-list")
        self._tls = tls
        self._started = threading.Event()
        self._server: uvicorn.Server | None = None
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        assert self._started.wait(60), "the server did not start within 60 s"

    def _app(self) -> Any:
        spec = importlib.util.spec_from_file_location("fake_run", FAKE_RUN)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        site = module.FakeRun(packages=4).site()
        header = site.view.header
        site.runs = (StoredRun(4, header, 8, 90, 500, 70, 0), StoredRun(site.view.id, header, 8, 90, 500, 66, 1))
        site.review = Reviewing(self.accepted, site.view.findings)
        site.against = against(site, lambda: [running_side(_running(site), "what runs")])
        page = self.robot.page
        routes = journal_routes(
            JournalView(self.journal, lambda seconds: f"{seconds:.1f}"), "rover",
            reactions=lambda: page.reactions, questions=self.questions,
        )  # fmt: skip
        return create_app(
            site, snapshot=page.newest, detail=page.detail, graph=page.graph, past=page.past, board=page.board,
            further=Further(routes, journal_links(acting=True, base="/")),
            access=Access({KEY: Person("Ada", Role.OPERATE), VIEW_KEY: Person("Vera", Role.VIEW)}),
        )  # fmt: skip

    def _run(self) -> None:
        # The store's connection belongs to the thread that opens it.
        tls = {"ssl_certfile": str(self._tls.certificate), "ssl_keyfile": str(self._tls.key)} if self._tls else {}
        server = uvicorn.Server(
            uvicorn.Config(self._app(), port=0, log_level="error", lifespan="off", ws="none", **tls)  # type: ignore[arg-type]
        )
        startup = server.startup

        async def tell(sockets: Any = None) -> None:
            await startup(sockets)
            self._server = server
            self._started.set()

        server.startup = tell  # type: ignore[method-assign]
        server.run()

    @property
    def url(self) -> str:
        """Where it is."""
        assert self._server is not None
        port = self._server.servers[0].sockets[0].getsockname()[1]
        return f"http{'s' if self._tls else ''}://127.0.0.1:{port}"

    def close(self) -> None:
        """Serve no more."""
        if self._server is not None:
            self._server.should_exit = True
            self._server.force_exit = True
        self._thread.join(10)


def signed_in(path: str, key: str = KEY) -> str:
    """Return a path that signs in on the way."""
    return f"{path}{'&' if '?' in path else '?'}token={quote(key)}"


def _running(site: Any) -> Graph:
    first = next(iter(site.book.systems.values()))
    graph = first.configuration.graph()
    return msgspec.structs.replace(graph, nodes=(*graph.nodes[1:], Node("/ui")))
