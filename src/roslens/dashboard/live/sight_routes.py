"""What readers see, over HTTP: a page reports it, and a request for an unseen entity waits for its values."""

from __future__ import annotations

import time
from collections.abc import Awaitable, Callable

from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from roslens.dashboard.live.past_routes import foreign
from roslens.dashboard.live.sight import Sight, seen_of


class SightRoutes:
    """Takes the reports of pages.

    Attributes:
        sight: what is seen.
    """

    def __init__(self, sight: Sight | None) -> None:
        """Report to ``sight``; None if everything is made regardless of readers."""
        self._partial = sight is not None
        self.sight = sight or Sight(time.monotonic)

    def routes(self) -> list[Route]:
        """Return where what is."""
        return [Route("/sees", self.sees)]

    async def sees(self, request: Request) -> Response:
        """Take the report of a page on what it sees."""
        if refusal := foreign(request):
            return refusal
        value = request.query_params.get
        seen = seen_of(value("rows", ""), value("links", ""), value("select", ""), value("picture", ""))
        if seen is None:
            return PlainTextResponse("Expected keys of rows and places of links, not too many.\n", status_code=400)
        if self.sight.tell(value("reader", ""), seen):
            return Response(status_code=204)
        # No error: its stream may be about to come back.
        return PlainTextResponse("No stream of this reader is open.\n")

    async def wait_for(self, entity: str, newer: Callable[[], Awaitable[None]]) -> None:
        """Let what is known of an entity be of the present; ``newer`` waits for the next snapshot."""
        if self.sight.ask(entity) and self._partial:
            await newer()
