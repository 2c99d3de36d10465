"""Why an entity is as it is, over HTTP."""

from __future__ import annotations

from collections.abc import Callable

from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from roslens.dashboard.live.past_routes import foreign, json_or_nothing


def why_route(why: Callable[[str], bytes]) -> Route:
    """Return where ``why``, which may take a while, is asked; that nothing is known of an entity is no error."""

    async def reason(request: Request) -> Response:
        if refusal := foreign(request):
            return refusal
        return json_or_nothing(await run_in_threadpool(why, request.query_params.get("select", "")))

    return Route("/why.json", reason)
