"""What every answer of the server carries, and which requests it does not answer."""

from __future__ import annotations

import math
import socket
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, parse_qsl, quote, urlencode

import msgspec
from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import HTMLResponse, PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from roslens.dashboard.access.person import ANYBODY, SCOPE_KEY, Person
from roslens.dashboard.access.policy import Access
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
SIGN_IN = "/-/sign-in"
"""Where the form of who has no session sends its token."""
LARGEST_BODY = 65_536
"""Bytes of an acting request."""

_READING = ("GET", "HEAD")
_FORM = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>roslens: a token is needed</title>
<h1>A token is needed</h1>
<p>{why}</p>
<form method="post" action="{action}">
<p><label for="token">Token</label> <input id="token" name="token" type="password" autocomplete="current-password"
required> <button>Sign in</button></p>
</form>
</html>
"""


class _Refusal(msgspec.Struct, frozen=True):
    """An answer that is not what was asked for, and why; ``counted`` against who asked."""

    status: int
    why: str
    retry_s: float = 0.0
    counted: bool = True


class Guard:
    """Refuses who may not ask, and adds the security headers to every answer.

    - The Host header names this machine: otherwise a page of somebody else could read this server, see
      ``intake/host_header.py``.
    - Who looks has a token where one is needed: as ``Authorization: Bearer``, or as a session that a browser keeps in a
      cookie once it opened an address with ``?token=`` or sent the form.
    - What is not GET or HEAD acts: it is a POST of somebody who may operate, by a page of this server (or by no page
      at all, with the token in its header), of bounded length, not too often; and it is written down. Applications
      behind add a route for POST and ask :func:`roslens.dashboard.access.person.person_of` who it was.
    """

    def __init__(
        self, app: ASGIApp, names: frozenset[str] = frozenset(), advice: str = "start `roslens serve` with --host",
        access: Access | None = None,
    ) -> None:  # fmt: skip
        """``names`` are further host names to answer to, in lower case; ``advice`` describes how to add one.

        Without ``access`` anyone may view, and no one may act.
        """
        self._app = app
        self._advice = advice
        self._names = names | {"localhost", socket.gethostname().lower()}
        self._access = access or Access()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return

        status: list[int] = []

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                status.append(message["status"])
                headers = MutableHeaders(scope=message)
                for name, value in HEADERS.items():
                    headers.setdefault(name, value)
            await send(message)

        if SCOPE_KEY in scope:
            # An application inside another one, whose guard has looked already.
            await self._app(scope, receive, send_guarded)
            return
        given = Headers(scope=scope).get("host", "")
        if not self.allows(given):
            refusal = PlainTextResponse(
                f"The host name {given[:80]!r} is not one of this server. Expected localhost or an address; "
                f"{self._advice} to answer to another name.\n",
                status_code=421,
            )
            await refusal(scope, receive, send_guarded)
            return
        if (signed := await self._sign_in(scope, receive)) is not None:
            await signed(scope, receive, send_guarded)
            return
        person = self._person(scope)
        if isinstance(person, _Refusal):
            await self._refused(scope, person)(scope, receive, send_guarded)
            return
        if (refusal_of_act := self._refusal(scope, person)) is not None:
            await self._refused(scope, refusal_of_act)(scope, receive, send_guarded)
            return
        scope[SCOPE_KEY] = person
        if scope["method"] in _READING:
            await self._app(scope, receive, send_guarded)
            return
        body = await _bounded(receive, LARGEST_BODY)
        if body is None:
            large = _Refusal(413, f"More than {LARGEST_BODY:,} bytes were sent.")
            await self._refused(scope, large)(scope, receive, send_guarded)
            return
        # What cannot be written down is not done.
        self._write_down(scope, person, 0)
        try:
            await self._app(scope, _replay(body, receive), send_guarded)
        finally:
            self._write_down(scope, person, status[0] if status else 500)

    def allows(self, given: str) -> bool:
        """Return whether a Host header names this server."""
        return names_this_machine(given, self._names)

    async def _sign_in(self, scope: Scope, receive: Receive) -> Response | None:
        """Answer who brings a token in the address or with the form; None where there is none."""
        query = scope["query_string"].decode("latin-1")
        if scope["method"] in _READING and "token" in (asked := dict(parse_qsl(query))):
            rest = [(name, value) for name, value in parse_qsl(query, keep_blank_values=True) if name != "token"]
            token, to = asked["token"], quote(scope["path"], safe="/@:+") + ("?" + urlencode(rest) if rest else "")
        elif scope["method"] == "POST" and scope["path"] == SIGN_IN:
            if not _same_origin(scope, needed=True):
                return self._refused(scope, _Refusal(403, "Only the form of this server may send a token."))
            body = await _bounded(receive, LARGEST_BODY)
            token, to = parse_qs((body or b"").decode("latin-1")).get("token", [""])[0], "/"
        else:
            return None
        person = self._access.tokens.holder(token)
        if person is None:
            return self._refused(scope, self._wrong_token(scope))
        # A path that begins with two slashes would lead to another server.
        answer = RedirectResponse("/" + to.lstrip("/\\"), status_code=303)
        answer.set_cookie(
            _cookie(scope), self._access.tokens.session_of(token), httponly=True, samesite="lax",
            secure=scope["scheme"] == "https",
        )  # fmt: skip
        self._write_down(scope, person, answer.status_code, "signed in")
        return answer

    def _person(self, scope: Scope) -> Person | _Refusal:
        """Return who asks; who brings a wrong token is refused even where none is needed."""
        given = Headers(scope=scope)
        kind, _, token = given.get("authorization", "").partition(" ")
        if kind.lower() == "bearer":
            return self._access.tokens.holder(token.strip()) or self._wrong_token(scope)
        held = _session(given.get("cookie", ""), _cookie(scope))
        if held and (person := self._access.tokens.in_session(held)) is not None:
            return person
        if self._access.view_needs_token:
            why = "Open the address that `roslens` printed, which has one in it, or give it here."
            return _Refusal(401, why, counted=False)
        return ANYBODY

    def _wrong_token(self, scope: Scope) -> _Refusal:
        # Only wrong ones wait: nobody guesses 256 random bits however often, and a page of somebody else in a browser
        # on the same machine could otherwise keep out everybody there.
        if (wait := self._access.refusals.wait(_source(scope))) > 0:
            return _Refusal(429, "Too many wrong tokens came from there.", wait, counted=False)
        return _Refusal(401, "That token is not one of this server.")

    def _refusal(self, scope: Scope, person: Person) -> _Refusal | None:
        """Return why a request is not allowed; None if it is."""
        method = scope["method"]
        if method in _READING:
            return None
        if method != "POST":
            return _Refusal(405, f"{method[:16]} is not answered. Expected GET, or POST of what acts.", counted=False)
        if not person.may_operate:
            return _Refusal(403, "Acting needs a token of the role operate.")
        by_header = Headers(scope=scope).get("authorization", "").lower().startswith("bearer ")
        if not _same_origin(scope, needed=not by_header):
            return _Refusal(403, "Only pages of this server may act with the session of its reader.")
        if (wait := self._access.acts.take(_peer(scope))) > 0:
            return _Refusal(429, "Too many acting requests came from there.", wait, counted=False)
        return None

    def _refused(self, scope: Scope, refusal: _Refusal) -> Response:
        # Who is refused without end is written down a few times only.
        if refusal.counted and self._access.refusals.take(_source(scope)) == 0:
            self._write_down(scope, None, refusal.status, refusal.why)
        headers = {"retry-after": str(math.ceil(refusal.retry_s))} if refusal.retry_s else {}
        if refusal.status == 405:
            headers["allow"] = "GET, HEAD, POST"
        if refusal.status == 401:
            headers["www-authenticate"] = "Bearer"
            if "text/html" in Headers(scope=scope).get("accept", ""):
                return HTMLResponse(_FORM.format(why=refusal.why, action=SIGN_IN), 401, headers)
        return PlainTextResponse(refusal.why + "\n", refusal.status, headers)

    def _write_down(self, scope: Scope, person: Person | None, status: int, why: str = "") -> None:
        self._access.write_down(
            peer=_peer(scope), person=person, method=scope["method"], path=scope["path"], status=status, why=why
        )


def _peer(scope: Scope) -> str:
    return scope["client"][0] if scope.get("client") else ""


def _source(scope: Scope) -> str:
    """Return what refusals are counted for: an address, and apart from it the pages of other origins in its browsers.

    All other origins of an address are one source: a program can name as many as it likes.
    """
    given = Headers(scope=scope)
    own = f"{scope['scheme']}://{given.get('host', '')}".lower()
    origins = (given.get("origin"), _origin_of(given.get("referer", "")))
    foreign = given.get("sec-fetch-site") in ("cross-site", "same-site") or any(
        one and one.lower() != own for one in origins
    )
    return f"{_peer(scope)} pages of other origins" if foreign else _peer(scope)


def _origin_of(address: str) -> str:
    scheme, separator, rest = address.partition("://")
    return scheme + separator + rest.partition("/")[0]


def _cookie(scope: Scope) -> str:
    # Cookies do not distinguish ports: two servers of a machine would otherwise sign each other's readers out.
    return f"roslens_{scope['server'][1]}" if scope.get("server") else "roslens"


def _session(cookies: str, name: str) -> str:
    try:
        found = SimpleCookie(cookies).get(name)
    except CookieError:
        return ""
    return found.value if found else ""


def _same_origin(scope: Scope, *, needed: bool) -> bool:
    """Return whether a page of this server sent it; ``needed``, whether a request without its origin is refused."""
    given = Headers(scope=scope)
    site = given.get("sec-fetch-site")
    if site not in (None, "same-origin"):
        return False
    origin = given.get("origin")
    if origin is None:
        return not needed
    # A form of a page that sends no referrer: browsers hide its origin, but still send its site.
    if origin == "null" and site is not None:
        return True
    return origin.lower() == f"{scope['scheme']}://{given.get('host', '')}".lower()


async def _bounded(receive: Receive, most: int) -> bytes | None:
    """Return the body of a request; None where it is longer than ``most`` bytes."""
    parts, size = [], 0
    while True:
        message = await receive()
        if message["type"] != "http.request":
            break
        parts.append(message.get("body", b""))
        size += len(parts[-1])
        if size > most:
            return None
        if not message.get("more_body"):
            break
    return b"".join(parts)


def _replay(body: bytes, receive: Receive) -> Receive:
    waiting = [body]

    async def again() -> Message:
        if waiting:
            return {"type": "http.request", "body": waiting.pop(), "more_body": False}
        return await receive()

    return again
