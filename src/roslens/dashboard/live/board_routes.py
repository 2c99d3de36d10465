"""References and notes on alerts over HTTP."""

from __future__ import annotations

import math
from collections.abc import Callable
from urllib.parse import parse_qs

import msgspec
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route

from roslens.dashboard.access.person import person_of
from roslens.dashboard.live.board import Board
from roslens.dashboard.live.past_routes import foreign

MOST_ACCEPTED = 1000


class BoardRoutes:
    """Answers what the page asks of a board."""

    def __init__(self, board: Board, page: Callable[[object, str, tuple[str, ...]], str]) -> None:
        """``page`` writes the page of references: what they are, the accepted document, the accepted keys."""
        self._board = board
        self._page = page

    def routes(self) -> list[Route]:
        """Return where what is."""
        return [
            Route("/references", self.references),
            Route("/references.json", self.references),
            Route("/accepted.yaml", self.accepted),
            Route("/handle", self.handle, methods=["POST"]),
        ]

    async def references(self, request: Request) -> Response:
        """Answer with what is expected and what it is about."""
        as_json = request.url.path.endswith(".json")
        if as_json and (refusal := foreign(request)):
            return refusal
        found = await run_in_threadpool(self._board.references)
        if as_json:
            return Response(msgspec.json.encode(found), media_type="application/json")
        accepted = _accepted(request)
        document = await run_in_threadpool(self._board.document, accepted) if accepted else ""
        return HTMLResponse(self._page(found, document, accepted))

    async def accepted(self, request: Request) -> Response:
        """Answer with the accepted lines as a file."""
        text = await run_in_threadpool(self._board.document, _accepted(request))
        headers = {"content-disposition": 'attachment; filename="accepted.yaml"'}
        return PlainTextResponse(text, media_type="application/yaml", headers=headers)

    async def handle(self, request: Request) -> Response:
        """Note something of an alert; whether who asks may was looked at before."""
        given = parse_qs((await request.body()).decode("utf-8", "replace"))
        key, how, length = (given.get(name, [""])[0] for name in ("key", "how", "for"))
        try:
            seconds = float(length or "0")
        except ValueError:
            seconds = math.nan
        if not math.isfinite(seconds):
            return PlainTextResponse(f"for={length[:40]!r}; expected seconds.\n", status_code=400)
        refusal = await run_in_threadpool(self._board.handle, key, how, seconds, person_of(request).name)
        if refusal:
            return PlainTextResponse(refusal + "\n", status_code=400)
        return RedirectResponse("./", status_code=303)


def _accepted(request: Request) -> tuple[str, ...]:
    return tuple(request.query_params.getlist("accept")[:MOST_ACCEPTED])
