"""Accepting findings over HTTP: a form that needs no JavaScript, answered by the page it came from."""

from __future__ import annotations

from urllib.parse import parse_qsl

from starlette.requests import Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route

from roslens.dashboard.access.person import person_of
from roslens.dashboard.review import LONGEST_REASON, Review

ACCEPT = "/accept"


def review_routes(review: Review) -> list[Route]:
    """Return where findings are accepted, and that is taken back."""

    async def accept(request: Request) -> Response:
        if not person_of(request).may_operate:
            return PlainTextResponse("Nothing was changed: it needs a token of the role operate.\n", status_code=403)
        form = dict(parse_qsl((await request.body()).decode("utf-8", "replace"), keep_blank_values=True))
        fingerprint, reason = form.get("fingerprint", ""), " ".join(form.get("reason", "").split())
        if "undo" in form:
            refusal = review.undo(fingerprint)
        elif not reason:
            refusal = "no reason is given; expected why the finding stays: whoever reviews the file reads it."
        elif len(reason) > LONGEST_REASON:
            refusal = f"the reason has {len(reason):,} characters; expected {LONGEST_REASON} or fewer."
        else:
            refusal = review.accept(fingerprint, reason, false_positive="false-positive" in form)
        if refusal:
            return PlainTextResponse(f"Nothing was changed: {refusal}\n", status_code=400)
        # A path that begins with two slashes would lead to another server.
        back = "/" + form.get("back", "findings").lstrip("/\\")
        return RedirectResponse(back.splitlines()[0], status_code=303)

    return [Route(ACCEPT, accept, methods=["POST"])]
