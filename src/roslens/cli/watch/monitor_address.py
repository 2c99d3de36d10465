"""Asking a monitor that serves its page: `roslens watch --serve`, `roslens serve --live`."""

from __future__ import annotations

import os
import urllib.error
import urllib.request
from collections.abc import Mapping
from urllib.parse import parse_qs, urlsplit, urlunsplit

from roslens.model.errors import UsageError

TOKEN_VARIABLE = "ROSLENS_TOKEN"  # noqa: S105 - a name
"""The variable that holds a token, where the address has none."""
PATIENCE_S = 10.0
_MOST_BYTES = 64 << 20
_PAGES = ("", "live/")
"""Where the live page is: of a watch at the root, beside the pages of a run below them."""
_EXPECTED = "a `roslens watch --serve` or `roslens serve --live`"


def fetched(address: str, what: str, environment: Mapping[str, str] = os.environ) -> bytes:
    """Return a document of the live page at an address; empty if the page has no content.

    A token that is part of the address, as the monitor printed it, or that of ``$ROSLENS_TOKEN``, is sent in a header.

    Raises:
        UsageError: there is no answer, a token is missing, or the server has no live page.
    """
    base, token = _parts(address, environment)
    tried = "nothing"
    for page in _PAGES:
        request = urllib.request.Request(f"{base}/{page}{what}")  # noqa: S310 - only http, see _parts
        if token:
            request.add_header("Authorization", f"Bearer {token}")
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:  # noqa: S310
                if answer.status == 204:
                    return b""
                if "json" in answer.headers.get("content-type", ""):
                    return bytes(answer.read(_MOST_BYTES))
                tried = "a page that is not a live page"
        except urllib.error.HTTPError as error:
            error.close()
            if error.code in (401, 403):
                raise UsageError(
                    f"{address} asks for a token",
                    expected=f"the address as the monitor printed it, or ${TOKEN_VARIABLE}",
                ) from None
            tried = f"{error.code} {error.reason}"
        except (OSError, ValueError) as error:
            raise UsageError(
                f"{address} does not answer: {getattr(error, 'reason', error)}", expected=_EXPECTED,
                advice="Use the address that it printed when it was started",
            ) from None  # fmt: skip
    raise UsageError(f"{address} answers with {tried}", expected=_EXPECTED)


def _parts(address: str, environment: Mapping[str, str]) -> tuple[str, str]:
    parts = urlsplit(address if "://" in address else f"http://{address}")
    if parts.scheme not in ("http", "https") or not parts.hostname:
        raise UsageError(f"{address!r}", expected="HOST:PORT, or an address that begins with http")
    token = next(iter(parse_qs(parts.query).get("token", [])), "") or environment.get(TOKEN_VARIABLE, "")
    path = parts.path.rstrip("/").removesuffix("/live")
    return urlunsplit((parts.scheme, parts.netloc, path, "", "")), token
