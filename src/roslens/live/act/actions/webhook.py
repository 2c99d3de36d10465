"""``webhook``: what happened is posted to a page of the web, as JSON."""

from __future__ import annotations

import json
import urllib.error
import urllib.request
from typing import Any
from urllib.parse import urlsplit

import msgspec

from roslens.live.act.host import seconds
from roslens.live.act.ros import ActionError
from roslens.model.acting.action_kind import action_kind
from roslens.model.acting.reaction import Decision


class _NoRedirect(urllib.request.HTTPRedirectHandler):
    """What was written in the document is where it goes, and nowhere else."""

    def redirect_request(self, *_: Any) -> None:
        """Follow nothing."""


def check(url: str) -> None:
    """Look whether a text is the address of a page.

    Raises:
        ActionError: it is none.
    """
    parts = urlsplit(url)
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise ActionError(f"the url {url[:80]!r}", expected="`https://host/path`")


def body_of(decision: Decision, text: str) -> bytes:
    """Return what is posted."""
    document = {
        "text": text or decision.text,
        "reaction": decision.reaction,
        "decision": decision.id,
        "entity": decision.entity,
        "first_cause": decision.first_cause,
        "time": decision.at_s,
        "because": [msgspec.to_builtins(one) for one in decision.because],
    }
    return json.dumps(document, ensure_ascii=False).encode()


def act(decision: Decision) -> str:
    """Post it.

    Raises:
        ActionError: the page does not answer in time, or not with a code of 2xx.
    """
    kind = action_kind("webhook")
    arguments = kind.filled(decision.action.arguments) if kind is not None else decision.action.arguments
    url = str(arguments["url"])
    check(url)
    headers = {"Content-Type": "application/json; charset=utf-8", "User-Agent": "roslens"}
    body = body_of(decision, str(arguments["text"]))
    request = urllib.request.Request(url, body, headers, method="POST")  # noqa: S310 - the scheme was looked at
    try:
        with urllib.request.build_opener(_NoRedirect).open(
            request, timeout=seconds(arguments, "timeout", 5.0)
        ) as answer:
            return f"posted to {urlsplit(url).hostname}, which answered {answer.status}"
    except urllib.error.HTTPError as error:
        error.close()
        raise ActionError(f"{urlsplit(url).hostname} answered {error.code}", expected="2xx") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "reason", error)
        raise ActionError(
            f"{urlsplit(url).hostname} could not be notified: {reason}", expected="an answer of 2xx"
        ) from None
