"""The journal and the questions over HTTP: pages that need no JavaScript, their JSON, and the answers to questions."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl, urlencode

import msgspec
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from starlette.requests import Request
from starlette.responses import HTMLResponse, JSONResponse, RedirectResponse, Response
from starlette.routing import BaseRoute, Mount, Route
from starlette.staticfiles import StaticFiles

import roslens
from roslens.dashboard.journal.journal_view import PAGE, JournalView
from roslens.dashboard.journal.questions import Questions
from roslens.dashboard.operator_key import OperatorKey, foreign
from roslens.dashboard.render import TEMPLATES

HERE = Path(__file__).parent
_MOST_BODY = 10_000
_MOST_NAME = 40
_FORM = "application/x-www-form-urlencoded"


class Acting:
    """What can be answered on the page, and with which key."""

    def __init__(self, questions: Questions, key: OperatorKey) -> None:
        self.questions = questions
        self.key = key


def journal_routes(
    view: JournalView, title: str, *, acting: Acting | None = None, wall: Callable[[], float] = time.time
) -> list[BaseRoute]:
    """Return the routes beside those of the live page.

    Args:
        view: of the journal.
        title: what is watched.
        acting: where questions can be answered; None shows the journal alone.
        wall: says seconds since the epoch.
    """
    return _Pages(view, title, acting, wall).routes()


def journal_links(*, acting: bool) -> tuple[tuple[str, str], ...]:
    """Return what the navigation has of it: address and word."""
    return (("journal", "Journal"), ("questions", "Questions")) if acting else (("journal", "Journal"),)


class _Pages:
    def __init__(self, view: JournalView, title: str, acting: Acting | None, wall: Callable[[], float]) -> None:
        self._view = view
        self._title = title
        self._acting = acting
        self._wall = wall
        self._environment = Environment(
            loader=FileSystemLoader([HERE / "templates", TEMPLATES]), autoescape=True, trim_blocks=True,
            lstrip_blocks=True, undefined=StrictUndefined,
        )  # fmt: skip

    def routes(self) -> list[BaseRoute]:
        found: list[BaseRoute] = [
            Route("/journal", self.journal),
            Route("/journal.json", self.journal_json),
            Route("/journal/state.json", self.state),
            Mount("/web/journal", StaticFiles(directory=HERE / "web")),
        ]
        if self._acting is not None:
            found += [
                Route("/questions", self.questions, methods=["GET"]),
                Route("/questions", self.answer, methods=["POST"]),
                Route("/questions.json", self.questions_json),
            ]
        return found

    # Not `async`: files are read, for which Starlette takes a thread.
    def journal(self, request: Request) -> Response:
        """Show entries, newest first."""
        chosen = _chosen(request)
        part = self._view.part(**chosen)
        older = ""
        if len(part.rows) == PAGE and part.rows[-1].n > 0:
            kept = {key: value for key, value in chosen.items() if value}
            older = urlencode({**kept, "before": part.rows[-1].n})
        return self._shown(
            "journal.html", "journal", part=part, chosen=chosen, older=older, path=str(self._view.path),
            version=self._version(),
        )  # fmt: skip

    def journal_json(self, request: Request) -> Response:
        """Return the same for programs."""
        found = self._view.part(**_chosen(request))
        return Response(msgspec.json.encode(found), media_type="application/json")

    def state(self, _: Request) -> Response:
        """Return what changes when there is something new to show."""
        return JSONResponse({"version": self._version()}, headers={"cache-control": "no-store"})

    def questions(self, request: Request) -> Response:
        """Show what is asked."""
        return self._questions(said=_SAID.get(request.query_params.get("said", ""), ""))

    def questions_json(self, _: Request) -> Response:
        """Return what is asked for programs; to answer takes the page or its key."""
        return Response(msgspec.json.encode(self._of_acting().questions.open()), media_type="application/json")

    async def answer(self, request: Request) -> Response:
        """Take an answer: of a page of this server, with the key."""
        acting = self._of_acting()
        address = request.client.host if request.client else ""
        if why := foreign(request):
            acting.questions.refused(address, why)
            return self._refusal(403, f"This answer was not taken: {why}.")
        if request.headers.get("content-type", "").partition(";")[0].strip() != _FORM:
            return self._refusal(415, f"This answer was not taken: expected {_FORM}.")
        body = b""
        async for piece in request.stream():
            body += piece
            if len(body) > _MOST_BODY:
                return self._refusal(413, f"This answer was not taken: it has more than {_MOST_BODY:,} bytes.")
        told = dict(parse_qsl(body.decode("utf-8", "replace"), keep_blank_values=True, max_num_fields=20))
        if why := acting.key.why_not(told.get("key", "")):
            if acting.key.too_many():
                return self._refusal(429, "Too many wrong keys came within a minute. Copy it from the terminal.")
            acting.questions.refused(address, why)
            return self._refusal(403, f"This answer was not taken: {why}. `roslens react` writes it when it begins.")
        word = told.get("answer", "")
        if word not in ("allow", "deny"):
            return self._refusal(400, f"This answer was not taken: {word[:40]!r} is neither `allow` nor `deny`.")
        name = "".join(one for one in told.get("name", "") if one.isprintable()).strip()[:_MOST_NAME]
        by = f"{name or 'an operator'} on the page ({address})"
        if not acting.questions.answer(told.get("decision", ""), allowed=word == "allow", by=by):
            return self._refusal(409, "This is asked no more: it was answered, its time is over, or its cause is gone.")
        return RedirectResponse(f"questions?said={word}", status_code=303)

    def _questions(self, said: str = "", problem: str = "", status: int = 200) -> HTMLResponse:
        now = self._wall()
        asked = [(one, max(round(one.until - now), 0)) for one in self._of_acting().questions.open()]
        return self._shown(
            "questions.html", "questions", status, asked=asked, said=said, problem=problem, version=self._version()
        )

    def _refusal(self, status: int, problem: str) -> HTMLResponse:
        return self._questions(problem=problem, status=status)

    def _of_acting(self) -> Acting:
        if self._acting is None:
            raise LookupError("nothing can be answered here")
        return self._acting

    def _version(self) -> str:
        asked: Sequence[Any] = self._acting.questions.open() if self._acting is not None else ()
        return "/".join((self._view.version(), *(one.decision for one in asked)))

    def _shown(self, template: str, page: str, status: int = 200, **told: Any) -> HTMLResponse:
        waiting = len(self._acting.questions.open()) if self._acting is not None else 0
        text = self._environment.get_template(template).render(
            page=page, title=self._title, links=journal_links(acting=self._acting is not None), waiting=waiting,
            release=roslens.__version__, **told,
        )  # fmt: skip
        # So that forms say where they come from, to this server alone.
        return HTMLResponse(text, status_code=status, headers={"referrer-policy": "same-origin"})


_SAID = {
    "allow": "Allowed. The journal says what becomes of it.",
    "deny": "Denied. Nothing is done.",
}


def _chosen(request: Request) -> dict[str, Any]:
    told = request.query_params
    before = told.get("before", "")
    return {
        "entity": told.get("entity", "")[:1000],
        "what": told.get("what", "")[:100],
        "text": told.get("text", "")[:200],
        "before": int(before) if before.isascii() and before.isdigit() and len(before) < 16 else None,
    }
