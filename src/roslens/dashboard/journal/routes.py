"""The journal and the questions over HTTP: pages that need no JavaScript, their JSON, and the answers to questions."""

from __future__ import annotations

import time
from collections import Counter
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
from roslens.dashboard.access.person import person_of
from roslens.dashboard.journal.journal_view import PAGE, JournalView
from roslens.dashboard.journal.plan import Countermeasure, plan_of
from roslens.dashboard.journal.questions import Questions
from roslens.dashboard.live.named_entities import linked
from roslens.dashboard.render import TEMPLATES
from roslens.model.acting.reaction import Reaction

HERE = Path(__file__).parent
_MINUTE_S, _HOUR_S = 60, 3600
_FORM = "application/x-www-form-urlencoded"


Navigation = Callable[[], Sequence[tuple[str, str]]]
"""Returns address and word of each page that all pages lead to; the application keeps it as ``state.navigation``."""


def journal_routes(
    view: JournalView, title: str, *, reactions: Callable[[], Sequence[Reaction] | None] = tuple,
    questions: Questions | None = None, wall: Callable[[], float] = time.time,
) -> list[BaseRoute]:  # fmt: skip
    """Return the routes beside those of the live page, or of a site; its ``state.navigation`` leads to them.

    Args:
        view: of the journal.
        title: what is watched.
        reactions: returns those of the reference that holds; None where none was given.
        questions: that can be answered; None shows the journal alone.
        wall: returns seconds since the epoch.
    """
    return _Pages(view, title, reactions, questions, wall).routes()


def journal_links(*, acting: bool, base: str = "") -> tuple[tuple[str, str], ...]:
    """Return what the navigation has of it: address, below ``base``, and word."""
    shown = (("plan", "Countermeasures"), ("journal", "Journal"), ("questions", "Questions"))
    return tuple((base + place, word) for place, word in shown[: 3 if acting else 2])


class _Pages:
    def __init__(
        self, view: JournalView, title: str, reactions: Callable[[], Sequence[Reaction] | None],
        questions: Questions | None, wall: Callable[[], float],
    ) -> None:  # fmt: skip
        self._view = view
        self._title = title
        self._reactions = reactions
        self._asked = questions
        self._wall = wall
        self._environment = Environment(
            loader=FileSystemLoader([HERE / "templates", TEMPLATES]), autoescape=True, trim_blocks=True,
            lstrip_blocks=True, undefined=StrictUndefined,
        )  # fmt: skip
        self._environment.globals["lasting"] = _lasting
        self._environment.filters["linked"] = linked

    def routes(self) -> list[BaseRoute]:
        found: list[BaseRoute] = [
            Route("/plan", self.plan),
            Route("/plan.json", self.plan_json),
            Route("/journal", self.journal),
            Route("/journal.json", self.journal_json),
            Route("/journal/state.json", self.state),
            Mount("/web/journal", StaticFiles(directory=HERE / "web")),
        ]
        if self._asked is not None:
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
            request, "journal.html", "journal", part=part, chosen=chosen, older=older, path=str(self._view.path),
            version=self._version(),
        )  # fmt: skip

    def journal_json(self, request: Request) -> Response:
        """Return the same for programs."""
        found = self._view.part(**_chosen(request))
        return Response(msgspec.json.encode(found), media_type="application/json")

    def plan(self, request: Request) -> Response:
        """Show what is to be done about faults."""
        return self._shown(
            request, "plan.html", "plan", plan=self._plan(), given=self._reactions() is not None,
            version=self._version(), asking=self._asking(),
        )  # fmt: skip

    def plan_json(self, _: Request) -> Response:
        """Return the same for programs."""
        return Response(msgspec.json.encode(self._plan()), media_type="application/json")

    def _asking(self) -> Counter[str]:
        asked = self._asked.open() if self._asked is not None else ()
        return Counter(one.decision.partition("/")[0] for one in asked)

    def _elsewhere(self) -> str:
        return self._view.page() if self._asked is None else ""

    def _plan(self) -> tuple[Countermeasure, ...]:
        return plan_of(self._reactions() or (), self._view.decided())

    def state(self, _: Request) -> Response:
        """Return what changes when there is something new to show."""
        return JSONResponse({"version": self._version()}, headers={"cache-control": "no-store"})

    def questions(self, request: Request) -> Response:
        """Show what is asked."""
        return self._questions(request, said=_SAID.get(request.query_params.get("said", ""), ""))

    def questions_json(self, _: Request) -> Response:
        """Return what is asked for programs; to answer takes the page or its key."""
        return Response(msgspec.json.encode(self._of_asked().open()), media_type="application/json")

    async def answer(self, request: Request) -> Response:
        """Take an answer; the guard has let through only who may operate, by a page of this server."""
        person = person_of(request)
        if not person.may_operate:
            return self._refusal(request, 403, "This answer was not taken: it needs a token of the role operate.")
        if request.headers.get("content-type", "").partition(";")[0].strip() != _FORM:
            return self._refusal(request, 415, f"This answer was not taken: expected {_FORM}.")
        form = dict(parse_qsl((await request.body()).decode("utf-8", "replace"), keep_blank_values=True))
        word = form.get("answer", "")
        if word not in ("allow", "deny"):
            return self._refusal(
                request, 400, f"This answer was not taken: {word[:40]!r} is neither `allow` nor `deny`."
            )
        by = f"{person.name} on the page ({request.client.host if request.client else 'no address'})"
        if not self._of_asked().answer(form.get("decision", ""), allowed=word == "allow", by=by):
            why = "This is asked no more: it was answered, its time is over, or its cause is gone."
            return self._refusal(request, 409, why)
        return RedirectResponse(f"questions?said={word}", status_code=303)

    def _questions(self, request: Request, said: str = "", problem: str = "", status: int = 200) -> HTMLResponse:
        now = self._wall()
        asked = [(one, max(round(one.until - now), 0)) for one in self._of_asked().open()]
        person = person_of(request)
        return self._shown(
            request,
            "questions.html",
            "questions",
            status,
            asked=asked,
            said=said,
            problem=problem,
            version=self._version(),
            name=person.name if person.may_operate else "",
        )

    def _refusal(self, request: Request, status: int, problem: str) -> HTMLResponse:
        return self._questions(request, problem=problem, status=status)

    def _of_asked(self) -> Questions:
        if self._asked is None:
            raise LookupError("nothing can be answered here")
        return self._asked

    def _version(self) -> str:
        asked: Sequence[Any] = self._asked.open() if self._asked is not None else ()
        return "/".join((self._view.version(), *(one.decision for one in asked)))

    def _shown(self, request: Request, template: str, page: str, status: int = 200, **more: Any) -> HTMLResponse:
        waiting = len(self._asked.open()) if self._asked is not None else 0
        links = request.app.state.navigation()
        text = self._environment.get_template(template).render(
            page=page, title=self._title, elsewhere=self._elsewhere(), waiting=waiting,
            links=links, live=next((href for href, word in links if word == "Live"), ""),
            release=roslens.__version__, **more,
        )  # fmt: skip
        return HTMLResponse(text, status_code=status)


def _lasting(seconds: int) -> str:
    """Return a length of time as journal.js writes it."""
    if seconds < _MINUTE_S:
        return f"{seconds} s"
    if seconds < _HOUR_S:
        return f"{seconds // _MINUTE_S} min {seconds % _MINUTE_S} s"
    return f"{seconds // _HOUR_S} h {seconds % _HOUR_S // _MINUTE_S} min"


_SAID = {
    "allow": "Allowed. The journal shows the outcome.",
    "deny": "Denied. Nothing is done.",
}


def _chosen(request: Request) -> dict[str, Any]:
    query = request.query_params
    before = query.get("before", "")
    return {
        "entity": query.get("entity", "")[:1000],
        "what": query.get("what", "")[:100],
        "text": query.get("text", "")[:200],
        "before": int(before) if before.isascii() and before.isdigit() and len(before) < 16 else None,
    }
