"""The pages over HTTP, on this machine by default."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import closing
from types import FrameType
from urllib.parse import urlencode

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request as HttpRequest
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

from roslens.dashboard.access.person import person_of
from roslens.dashboard.access.policy import Access
from roslens.dashboard.address import PageRef, ServedLinks
from roslens.dashboard.computation.to_svg import to_svg
from roslens.dashboard.guard import Guard
from roslens.dashboard.listener import Tls, address_shown, listen
from roslens.dashboard.live.app import Facts, create_live_app, no_graph, nothing
from roslens.dashboard.live.board import Board
from roslens.dashboard.live.further import Further
from roslens.dashboard.live.past import Past
from roslens.dashboard.live.sight import Sight
from roslens.dashboard.live.snapshot import Snapshot, names_in
from roslens.dashboard.pages.entity import page_of
from roslens.dashboard.render import WEB, Renderer
from roslens.dashboard.review_routes import review_routes
from roslens.dashboard.routes import PAGES, Target, candidates
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import to_csv
from roslens.dashboard.view import Query, Request, View
from roslens.model.errors import StoreError

_LIVE = "/live/"
LIVE_WEB = WEB.parent / "live" / "web"
_OF_GRAPHS = ("/computation/", "/nodes/", "/topics/")
_GRACE_S = 2
_RETRY_S = 5
_ADVICE = "start `roslens serve` with --host HOST"
_MEDIA: Mapping[str, str] = {"json": "application/json", "csv": "text/csv; charset=utf-8"}


def create_app(
    site: Site,
    names: frozenset[str] = frozenset(),
    *,
    snapshot: Callable[[], bytes] | None = None,
    detail: Callable[[str], bytes] = nothing,
    why: Callable[[str], bytes] = nothing,
    graph: Callable[[], bytes] = no_graph,
    past: Past | None = None,
    board: Board | None = None,
    state: Callable[[], Snapshot | None] | None = None,
    sight: Sight | None = None,
    further: Further | None = None,
    stopped: Callable[[], bool] = lambda: False,
    access: Access | None = None,
) -> Starlette:
    """Return the application that shows ``site``.

    Args:
        site: what to show.
        names: further host names that it answers to.
        snapshot: returns the newest snapshot of what runs, for a live page beside the others.
        detail: returns all that is known of one of its entities.
        why: returns why one of its entities is as it is.
        graph: returns its computation graph as JSON.
        past: of what runs; None where nothing is kept.
        board: its references, and notes on its alerts.
        state: returns what `snapshot` returns before it is JSON.
        sight: is given what readers of it see.
        further: pages beside these.
        stopped: whether streams of snapshots should end.
        access: who may view and who may act; by default anyone may view and no one may act.
    """
    further = further or Further()
    of_live = ((_LIVE, "Live"),) if snapshot is not None else ()
    of_board = ((f"{_LIVE}references", "References"),) if snapshot is not None and board is not None else ()
    own = (*of_live, *of_board, *further.links)
    renderer = Renderer(site, "served", own, further.waiting)
    links = ServedLinks()

    # Views read a connection that belongs to one thread, and answer in milliseconds: so no worker threads.
    async def answer(request: HttpRequest) -> Response:
        query = Query(request.query_params.multi_items())
        for target in candidates(request.path_params["path"]):
            view = PAGES[target.page](site, _request(target, query))
            if view is not None and (response := _respond(request, site, renderer, links, view, target)):
                return response
        return _missing(renderer, links, request.url.path, site.reading)

    async def failed(request: HttpRequest, error: Exception) -> Response:  # noqa: ARG001 - Starlette's shape
        view = View(PageRef("help"), "The run cannot be read", {}, shown={"what": str(error), "advice": ""})
        try:
            text = renderer.message(view, links)
        except StoreError:
            # What stands around every page is read from the store, too.
            text = renderer.text("alone.html", what=str(error), live=_LIVE if snapshot is not None else "")
        return HTMLResponse(text, status_code=503, headers={"retry-after": str(_RETRY_S)})

    async def entity(request: HttpRequest) -> Response:
        asked = request.query_params.get("id", "")
        ref = page_of(site, asked)
        if ref is None and snapshot is not None:
            return RedirectResponse(f"{_LIVE}?{urlencode({'select': asked})}", status_code=303)
        name = asked.partition(":")[2]
        return RedirectResponse(links.to(ref or PageRef("search", query=(("q", name),))), status_code=303)

    async def picture(request: HttpRequest) -> Response:
        system = site.book.systems.get(request.path_params["slug"])
        if system is None:
            return _missing(renderer, links, request.url.path, site.reading)
        text = to_svg(system.configuration, system.findings, unstarted=site.book.unstarted)
        return Response(text, media_type="image/svg+xml")

    beside: list[BaseRoute] = []
    if snapshot is not None:
        site.running = lambda: names_in(snapshot())
        facts = Facts(
            names, advice=_ADVICE, pages=lambda: renderer.navigation(site, links), access=access,
            further=Further(links=further.links, waiting=further.waiting),
        )  # fmt: skip
        live = create_live_app(
            snapshot,
            facts,
            detail=detail,
            why=why,
            graph=graph,
            past=past,
            board=board,
            state=state,
            sight=sight,
            stopped=stopped,
        )
        beside = [Route(_LIVE.rstrip("/"), lambda _: RedirectResponse(_LIVE)), Mount(_LIVE, live)]
    app = Starlette(
        routes=[
            *beside,
            *further.routes,
            *(review_routes(site.review) if site.review is not None else ()),
            Mount("/web/live", StaticFiles(directory=LIVE_WEB)),
            Mount("/web", StaticFiles(directory=WEB)),
            Route("/entity", entity),
            Route("/computation", _richest(site, renderer, links)),
            Route("/computation/{slug}.svg", picture),
            Route("/favicon.ico", lambda _: PlainTextResponse("", status_code=404)),
            Route("/{path:path}", answer),
        ],
        middleware=[Middleware(Guard, names=names, access=access)],
        exception_handlers={StoreError: failed},
    )
    app.state.navigation = lambda: (*renderer.navigation(site, links), *own)
    return app


def _request(target: Target, query: Query) -> Request:
    return Request(target.key, query, complete=target.form == "csv")


def _respond(
    request: HttpRequest, site: Site, renderer: Renderer, links: ServedLinks, view: View, target: Target
) -> Response | None:
    if target.form == "html":
        may = site.review is not None and person_of(request).may_operate
        return HTMLResponse(renderer.page(view, links, may=may))
    if target.form == "json":
        return Response(view.to_json(site.run_facts()), media_type=_MEDIA["json"])
    table = next((table for table in view.tables if table.name == target.table or not target.table), None)
    return Response(to_csv(table), media_type=_MEDIA["csv"]) if table else None


def _richest(site: Site, renderer: Renderer, links: ServedLinks) -> Callable[[HttpRequest], Response]:
    """Return what leads from the address of no graph to the first one, which is the richest."""

    def answer(request: HttpRequest) -> Response:
        slug = next(iter(site.book.systems), "")
        if not slug:
            return _missing(renderer, links, request.url.path, site.reading)
        return RedirectResponse(links.to(PageRef("computation", slug)), status_code=303)

    return answer


def _missing(renderer: Renderer, links: ServedLinks, path: str, reading: str) -> Response:
    view = View(
        PageRef("help"),
        "No such page",
        {},
        shown={
            "what": f"There is nothing at {path}.",
            "advice": f"{reading}: try again in a moment."
            if reading and path.startswith(_OF_GRAPHS)
            else "It may be part of another run, or have another name. Search for it, or start at the overview.",
        },
    )
    return HTMLResponse(renderer.message(view, links), status_code=404)


def serve(
    site: Site,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    ready: Callable[[str], None] = lambda _: None,
    snapshot: Callable[[], bytes] | None = None,
    detail: Callable[[str], bytes] = nothing,
    why: Callable[[str], bytes] = nothing,
    graph: Callable[[], bytes] = no_graph,
    past: Past | None = None,
    board: Board | None = None,
    state: Callable[[], Snapshot | None] | None = None,
    sight: Sight | None = None,
    further: Further | None = None,
    access: Access | None = None,
    tls: Tls | None = None,
) -> None:
    """Serve until interrupted.

    Args:
        site: what to show.
        host: name or address to listen on; only this machine by default.
        port: to listen on; 0 takes a free one.
        ready: called with the address of the first page once connections are accepted.
        snapshot: returns the newest snapshot of what runs, for a live page; called from this thread.
        detail: returns all that is known of one of its entities; called from this thread too.
        why: returns why one of its entities is as it is; called from a thread of its own.
        graph: returns its computation graph as JSON; called from this thread too.
        past: of what runs; None where nothing is kept.
        board: its references, and notes on its alerts.
        state: returns what `snapshot` returns before it is JSON.
        sight: is given what readers of it see.
        further: pages beside these.
        access: who may view and who may act; by default anyone may view and no one may act.
        tls: certificate and key to encrypt with.

    Raises:
        UsageError: the host is unknown, or the port is taken or not allowed.
    """
    import uvicorn

    from roslens.dashboard.patient_protocol import PatientProtocol

    stopping: list[bool] = []

    class Server(uvicorn.Server):
        def handle_exit(self, sig: int, frame: FrameType | None) -> None:
            stopping.append(True)
            super().handle_exit(sig, frame)

    names = frozenset({host.lower()})
    app = create_app(
        site, names, snapshot=snapshot, detail=detail, why=why, graph=graph, past=past, board=board,
        state=state, sight=sight, further=further, stopped=lambda: bool(stopping), access=access,
    )  # fmt: skip
    local, free = (
        "Leave --host out to listen on this machine only",
        "Give another one with --port, or --port 0 for any free one",
    )
    with closing(listen(host, port, local=local, free=free)) as listener:
        ready(address_shown(listener, encrypted=tls is not None))
        config = uvicorn.Config(
            app, log_level="error", access_log=False, lifespan="off", server_header=False, ws="none",
            http=PatientProtocol, timeout_graceful_shutdown=_GRACE_S,
            ssl_certfile=tls.certificate if tls else None, ssl_keyfile=tls.key if tls else None,
        )  # fmt: skip
        try:
            Server(config).run(sockets=[listener])
        except KeyboardInterrupt:
            # Ctrl-C is how a reader ends it, not an error.
            return
