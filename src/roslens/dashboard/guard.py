"""What every answer of the server carries, and which requests it does not answer."""

from __future__ import annotations

import socket

from starlette.datastructures import MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from roslens.intake.host_header import names_this_machine

POLICY = (
    "default-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'; object-src 'none'; "
    "img-src 'self' data:"
)
HEADERS = {
    "content-security-policy": POLICY,
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cache-control": "no-cache",
}


class Guard:
    """Refuses requests under a foreign host name and adds the security headers.

    Otherwise a page of somebody else could read this server, see ``intake/host_header.py``.
    """

    def __init__(
        self, app: ASGIApp, names: frozenset[str] = frozenset(), advice: str = "start `roslens serve` with --host"
    ) -> None:
        """``names`` are further host names to answer to, in lower case; ``advice`` says how to add one."""
        self._app = app
        self._advice = advice
        self._names = names | {"localhost", socket.gethostname().lower()}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        given = next((value.decode("latin-1") for name, value in scope["headers"] if name == b"host"), "")
        if not self.allows(given):
            refusal = PlainTextResponse(
                f"The host name {given[:80]!r} is not one of this server. Expected localhost or an address; "
                f"{self._advice} to answer to another name.\n",
                status_code=421,
            )
            await refusal(scope, receive, send_guarded)
            return
        await self._app(scope, receive, send_guarded)

    def allows(self, given: str) -> bool:
        """Return whether a Host header names this server."""
        return names_this_machine(given, self._names)
