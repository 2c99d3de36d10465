"""The past of the live page over HTTP: moments, plots, sparklines, marks and what changed between two moments."""

from __future__ import annotations

import math
from collections.abc import Callable

import msgspec
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response
from starlette.routing import Route

from roslens.dashboard.live.past import Past

MOST_SPARKS = 120
"""Entities of which sparklines are asked at once."""
_USUAL_POINTS = 600
_USUAL_S = 300.0


class MomentError(Exception):
    """A parameter of the address is not a time; the message states which, and what is expected."""


class PastRoutes:
    """Answers what the page asks of the past; each question in a thread, since a history may be large."""

    def __init__(self, past: Past, page: Callable[[object], str]) -> None:
        """``page`` writes the page of two moments."""
        self._past = past
        self._page = page

    def routes(self) -> list[Route]:
        """Return where what is."""
        return [
            Route("/plots.json", self.plots),
            Route("/sparks.json", self.sparks),
            Route("/timeline.json", self.timeline),
            Route("/compared", self.compared),
            Route("/compared.json", self.compared),
        ]

    async def snapshot(self, at: str) -> bytes:
        """Return how it was at a moment as the address has it.

        Raises:
            MomentError: it is none.
        """
        return await run_in_threadpool(self._past.snapshot, seconds("at", at))

    async def detail(self, entity: str, at: str) -> bytes:
        """Return what was known of an entity then.

        Raises:
            MomentError: it is none.
        """
        return await run_in_threadpool(self._past.detail, entity, seconds("at", at))

    async def plots(self, request: Request) -> Response:
        """Answer with the signals of an entity."""
        if refusal := foreign(request):
            return refusal
        asked = request.query_params
        until = seconds("until", asked.get("until", ""))
        since = seconds("since", asked["since"]) if "since" in asked else until - _USUAL_S
        most = int(seconds("points", asked.get("points", str(_USUAL_POINTS))))
        found = await run_in_threadpool(self._past.plots, asked.get("select", ""), since, max(until, since), most)
        return _json(found)

    async def sparks(self, request: Request) -> Response:
        """Answer with the course of the foremost signal of several entities."""
        if refusal := foreign(request):
            return refusal
        entities = tuple(request.query_params.getlist("of")[:MOST_SPARKS])
        until = seconds("until", request.query_params.get("until", ""))
        return _json(await run_in_threadpool(self._past.sparks, entities, until))

    async def timeline(self, request: Request) -> Response:
        """Answer with what happened."""
        if refusal := foreign(request):
            return refusal
        since, until = (seconds(name, request.query_params.get(name, "0")) for name in ("since", "until"))
        found = await run_in_threadpool(self._past.timeline, since, until)
        return Response(status_code=204) if found is None else _json(found)

    async def compared(self, request: Request) -> Response:
        """Answer with what changed between two moments, as a page or as JSON."""
        as_json = request.url.path.endswith(".json")
        if as_json and (refusal := foreign(request)):
            return refusal
        since, until = (seconds(name, request.query_params.get(name, "")) for name in ("from", "to"))
        found = await run_in_threadpool(self._past.compared, since, until)
        if as_json:
            return Response(status_code=204) if found is None else _json(found)
        return HTMLResponse(self._page(found), status_code=404 if found is None else 200)


def seconds(name: str, text: str) -> float:
    """Return the seconds in a parameter.

    Raises:
        MomentError: it is no finite number.
    """
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise MomentError(f"{name}={text[:40]!r}; expected seconds since the epoch, such as {name}=1700000000.5")
    return found


def foreign(request: Request) -> Response | None:
    """Refuse requests of pages of other origins, which browsers mark."""
    if request.headers.get("sec-fetch-site", "none") in ("same-origin", "none"):
        return None
    return PlainTextResponse("Only pages of this server may read this.\n", status_code=403)


def json_or_nothing(text: bytes) -> Response:
    """Answer with JSON, or that there is nothing."""
    return Response(text, media_type="application/json") if text else Response(status_code=204)


async def unreadable(_: Request, error: Exception) -> Response:
    """Respond that the history cannot be read."""
    return PlainTextResponse(f"{error}\n", status_code=503)


async def refused(_: Request, error: Exception) -> Response:
    """Respond with the error in the address."""
    return PlainTextResponse(f"{error}\n", status_code=400)


def _json(found: object) -> Response:
    return Response(msgspec.json.encode(found), media_type="application/json")
