"""A document of a file or a URL, bounded in size, fetched again where the network broke it."""

from __future__ import annotations

import http.client
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path
from typing import IO, TYPE_CHECKING

from roslens.intake.bounded_file import read_bounded
from roslens.intake.safe_yaml import MOST_BYTES
from roslens.model.errors import UsageError
from roslens.source.fetch.retry import Retry

if TYPE_CHECKING:
    from email.message import Message

TIMEOUT_S = 30.0
_AGAIN = frozenset({408, 429, 500, 502, 503, 504})

Read = Callable[[str], bytes]
"""Returns what a file or a URL holds; raises UsageError."""


def is_url(place: str) -> bool:
    """Return whether a place is a URL rather than a path."""
    return place.startswith(("http://", "https://", "file://"))


def reader(retry: Retry, *, offline: bool) -> Read:
    """Return what reads documents.

    Args:
        retry: how often a server is asked again.
        offline: whether servers are not asked.
    """

    def read(place: str) -> bytes:
        if place.startswith("file://") or not is_url(place):
            return _of_file(place.removeprefix("file://"))
        if offline:
            raise UsageError(
                f'"{place}" is on the network', expected="with --offline, a file", advice="Give --distribution FILE"
            )
        return _of_server(place, retry)

    return read


def _of_file(path: str) -> bytes:
    try:
        return read_bounded(Path(path), MOST_BYTES)
    except OSError as error:
        raise UsageError(
            f'"{path}" cannot be read, {error.strerror}', expected="a file or a URL that names repositories"
        ) from error


def _of_server(url: str, retry: Retry) -> bytes:
    for pause in (*retry.pauses_s, None):
        wrong, again = "", True
        try:
            with _opener().open(url, timeout=TIMEOUT_S) as answer:
                content: bytes = answer.read(MOST_BYTES + 1)
            if len(content) <= MOST_BYTES:
                return content
            wrong, again = f"more than {MOST_BYTES:,} bytes", False
        except urllib.error.HTTPError as error:
            error.close()
            wrong, again = f"the server answers {error.code} {error.reason}", error.code in _AGAIN
        except urllib.error.URLError as error:
            wrong = str(error.reason)
        except (OSError, http.client.HTTPException, ValueError) as error:
            wrong = str(error) or type(error).__name__
        if pause is None or not again:
            break
        retry.sleep(pause)
    raise UsageError(
        f'"{url}" cannot be read: {wrong}',
        expected="a document that names repositories",
        advice="Check the address and the network, or give a file that you have with --distribution FILE",
    )


class _WebOnly(urllib.request.HTTPRedirectHandler):
    """Follows to http and https only: a server cannot point at files of this machine."""

    def redirect_request(
        self, req: urllib.request.Request, fp: IO[bytes], code: int, msg: str, headers: Message, newurl: str
    ) -> urllib.request.Request | None:
        if not newurl.startswith(("http://", "https://")):
            raise urllib.error.URLError(f"it leads to {newurl!r}")
        return super().redirect_request(req, fp, code, msg, headers, newurl)  # type: ignore[arg-type]


def _opener() -> urllib.request.OpenerDirector:
    opener = urllib.request.OpenerDirector()
    for handler in (
        urllib.request.ProxyHandler(),
        urllib.request.HTTPHandler(),
        urllib.request.HTTPSHandler(),
        urllib.request.HTTPDefaultErrorHandler(),
        _WebOnly(),
        urllib.request.HTTPErrorProcessor(),
    ):
        opener.add_handler(handler)
    return opener
