"""The live page over HTTP: the page, the snapshot it shows, and a stream of what changes of it."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence
from pathlib import Path

import msgspec
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

import roslens
from roslens.dashboard.access.person import person_of
from roslens.dashboard.access.policy import Access
from roslens.dashboard.guard import Guard
from roslens.dashboard.live.board import Board
from roslens.dashboard.live.board_routes import BoardRoutes
from roslens.dashboard.live.changes import held
from roslens.dashboard.live.further import Further
from roslens.dashboard.live.named_entities import linked
from roslens.dashboard.live.past import Past
from roslens.dashboard.live.past_routes import MomentError, PastRoutes, foreign, json_or_nothing, refused, unreadable
from roslens.dashboard.live.sight import Sight
from roslens.dashboard.live.sight_routes import SightRoutes
from roslens.dashboard.live.snapshot import Snapshot
from roslens.dashboard.live.snapshot_stream import SnapshotStream
from roslens.dashboard.live.why_route import why_route
from roslens.dashboard.render import TEMPLATES, WEB
from roslens.model.errors import StoreError

HERE = Path(__file__).parent
MOST_PLAIN = 300
"""Rows that are written into the page itself; the script writes the others, and without it a link leads to all."""
MOST_READERS = 32
"""Streams at a time; each reader holds a connection."""
_LOOK_S = 0.1
_BEAT_S = 1.0
_SOON_S = 1.0
_LONGEST_READER = 40
_BEAT = b"event: beat\ndata:\n\n"
_KEYS = (
    ("j k", "next and previous row"),
    ("← →", "close and open a row"),
    ("Enter", "show the row in the graph"),
    ("/", "filter"),
    ("w", "only rows worse than ok"),
    ("[ ]", "the moment of the event before and after"),
    ("p n", "play the past, back to now"),
    ("+ - 0", "zoom the graph, all of it; so does the wheel with Ctrl, or once the graph was clicked"),
    ("Esc", "clear the selection"),
    ("d", "light or dark"),
    ("?", "this help"),
)


class Facts(msgspec.Struct, frozen=True):
    """What the application knows of the server it runs in.

    Attributes:
        names: further host names that it answers to, in lower case.
        advice: how to make it answer to another name.
        pace_s: least time between two pieces of a stream.
        pages: returns address and word of the pages of a run that are served beside it; none by default.
        access: who may view and who may act; by default anyone may view and no one may act.
        further: pages beside this one.
    """

    names: frozenset[str] = frozenset()
    advice: str = "start `roslens watch` with --serve HOST:PORT"
    pace_s: float = 0.25
    pages: Callable[[], Sequence[tuple[str, str]]] = tuple
    access: Access | None = None
    further: Further = Further()


def nothing(_: str) -> bytes:
    """Return no detail of any entity."""
    return b""


def no_graph() -> bytes:
    """Return no graph."""
    return b""


def create_live_app(
    snapshot: Callable[[], bytes], facts: Facts | None = None, *, detail: Callable[[str], bytes] = nothing,
    graph: Callable[[], bytes] = no_graph, past: Past | None = None, board: Board | None = None,
    state: Callable[[], Snapshot | None] | None = None, sight: Sight | None = None,
    stopped: Callable[[], bool] = lambda: False, why: Callable[[str], bytes] = nothing,
) -> Starlette:  # fmt: skip
    """Return the application.

    Args:
        snapshot: returns the newest snapshot as JSON; the same object while nothing is new. Called from the server's
            thread.
        facts: of the server.
        detail: returns all that is known of an entity as JSON, empty of one that is not there. Called from there too.
        graph: returns the computation graph as JSON, empty where none is known yet. Called from there too.
        past: of what is shown; None where nothing is kept.
        board: references and notes on alerts.
        state: returns what `snapshot` returns before it is JSON; by default that is read again.
        sight: is given what readers see, where snapshots are made of that.
        stopped: whether streams should end.
        why: returns as JSON why an entity is as it is, empty where nothing is known. Called from a thread of its own.
    """
    facts = facts or Facts()
    snapshots = SnapshotStream(state or _Read(snapshot))
    templates = _Templates(facts, past is not None, board is not None, snapshots)
    seeing = SightRoutes(sight)
    streams = _Streams(snapshots, facts.pace_s, stopped, seeing.sight)
    memory = PastRoutes(past, templates.compared) if past is not None else None

    async def show(request: Request) -> Response:
        at = request.query_params.get("at", "")
        text = await memory.snapshot(at) if memory is not None and at else b""
        then = at if text else ""
        snapshots.look()
        shown = held(msgspec.json.decode(text, type=Snapshot)) if then else snapshots.newest()
        may = board is not None and person_of(request).may_operate
        plain = len(shown.rows) if "all" in request.query_params else MOST_PLAIN
        return HTMLResponse(templates.live(shown, then, "" if then else snapshots.mark(), may, plain))

    async def twin(request: Request) -> Response:
        if refusal := foreign(request):
            return refusal
        at = request.query_params.get("at", "")
        if at and memory is not None:
            return json_or_nothing(await memory.snapshot(at))
        seeing.sight.take_all()
        return Response(snapshot(), media_type="application/json")

    async def about(request: Request) -> Response:
        if refusal := foreign(request):
            return refusal
        entity, at = request.query_params.get("select", ""), request.query_params.get("at", "")
        if not at:
            await seeing.wait_for(entity, streams.next)
        # That nothing is known of an entity is no error: it may have gone since it was chosen.
        return json_or_nothing(await memory.detail(entity, at) if at and memory is not None else detail(entity))

    async def whole(request: Request) -> Response:
        return foreign(request) or Response(graph() or b"{}", media_type="application/json")

    async def events(request: Request) -> Response:
        if refusal := foreign(request):
            return refusal
        if streams.readers >= MOST_READERS:
            return PlainTextResponse(f"{MOST_READERS} readers are served already.\n", status_code=503)
        reader = request.query_params.get("reader", "")[:_LONGEST_READER]
        return StreamingResponse(
            streams.read(request.headers.get("last-event-id") or request.query_params.get("after", ""), reader),
            media_type="text/event-stream",
            headers={"cache-control": "no-store", "x-accel-buffering": "no"},
        )

    app = Starlette(
        routes=[
            Route("/", show),
            Route("/snapshot.json", twin),
            Route("/events", events),
            *seeing.routes(),
            Route("/detail.json", about),
            why_route(why),
            Route("/graph.json", whole),
            *facts.further.routes,
            *(memory.routes() if memory is not None else ()),
            *(BoardRoutes(board, templates.references).routes() if board is not None else ()),
            Mount("/web/live", StaticFiles(directory=HERE / "web")),
            Mount("/web", StaticFiles(directory=WEB)),
        ],
        middleware=[Middleware(Guard, names=facts.names, advice=facts.advice, access=facts.access)],
        exception_handlers={StoreError: unreadable, MomentError: refused},
    )
    app.state.navigation = templates.navigation
    return app


class _Read:
    """Reads snapshots that come as JSON; each once."""

    def __init__(self, snapshot: Callable[[], bytes]) -> None:
        self._snapshot = snapshot
        self._text = b""
        self._state: Snapshot | None = None

    def __call__(self) -> Snapshot:
        text = self._snapshot()
        if self._state is None or (text is not self._text and text != self._text):
            self._state = msgspec.json.decode(text, type=Snapshot)
        self._text = text
        return self._state


class _Streams:
    """Hands pieces to readers; who reads slowly gets what it lacks when it is ready for it."""

    def __init__(self, snapshots: SnapshotStream, pace_s: float, stopped: Callable[[], bool], sight: Sight) -> None:
        self._snapshots = snapshots
        self._pace_s = pace_s
        self._stopped = stopped
        self._sight = sight
        self.readers = 0

    async def next(self) -> None:
        """Wait for the next snapshot, where one comes soon."""
        clock = asyncio.get_running_loop().time
        number, end = self._snapshots.look(), clock() + _SOON_S
        while self._snapshots.newest_lives() and self._snapshots.look() == number and clock() < end:
            await asyncio.sleep(_LOOK_S / 2)

    async def read(self, mark: str, reader: str) -> AsyncIterator[bytes]:
        """Yield what is new to a reader at ``mark``, and a heartbeat each second without news."""
        clock = asyncio.get_running_loop().time
        snapshots = self._snapshots
        snapshots.look()
        number, sent_at = snapshots.number_of(mark), clock() - self._pace_s
        self.readers += 1
        # Who comes again before it was noticed that it went is another one, and so is each without a name.
        stream = object()
        self._sight.enter(stream, reader)
        try:
            yield b"retry: 1000\n\n"
            while not self._stopped():
                newest, now = snapshots.look(), clock()
                if newest != number and now - sent_at >= self._pace_s - _LOOK_S / 2:
                    text, number, sent_at = snapshots.since(number), newest, now
                    yield text
                elif now - sent_at >= _BEAT_S:
                    sent_at = now
                    yield _BEAT
                await asyncio.sleep(min(_LOOK_S, self._pace_s))
        finally:
            self.readers -= 1
            self._sight.leave(stream)


def _embeddable(text: bytes) -> Markup:
    """Return JSON that may stand inside a script element: nothing in it can end the element."""
    safe = text.decode().replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
    return Markup(safe)  # noqa: S704 - escaped


class _Templates:
    """Writes the pages of one server."""

    def __init__(self, facts: Facts, remembers: bool, boards: bool, snapshots: SnapshotStream) -> None:
        self._pages = facts.pages
        self._snapshots = snapshots
        own = (("./", "Live"), ("references", "References")) if boards else (("./", "Live"),)
        self._own = (*own, *facts.further.links)
        environment = Environment(
            loader=FileSystemLoader([HERE / "templates", TEMPLATES]),
            autoescape=True,
            trim_blocks=True,
            lstrip_blocks=True,
            undefined=StrictUndefined,
        )
        environment.filters["linked"] = linked
        environment.globals.update(
            version=roslens.__version__,
            navigation=self.navigation,
            remembers=remembers,
            keys=_KEYS,
            title=self._title,
            waiting=facts.further.waiting,
        )
        self._live = environment.get_template("live.html")
        self._compared = environment.get_template("compared.html")
        self._references = environment.get_template("references.html")

    def navigation(self) -> tuple[tuple[str, str], ...]:
        """Return address and word of each page that all of these lead to."""
        return (*self._pages(), *self._own)

    def _title(self) -> str:
        self._snapshots.look()
        return self._snapshots.newest().title

    def live(self, shown: Snapshot, at: str, mark: str, may: bool, plain: int) -> str:
        text = _embeddable(msgspec.json.encode(shown))
        return self._live.render(
            snapshot=shown, text=text, at=at, mark=mark, may=may, plain=plain, pages=self._pages()
        )  # fmt: skip

    def compared(self, found: object) -> str:
        return self._compared.render(found=found)

    def references(self, found: object, document: str, accepted: tuple[str, ...]) -> str:
        return self._references.render(found=found, document=document, accepted=accepted)
