"""Asking a forge: with a token, tags, limits of rate, and no more patience than is reasonable."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

import msgspec

from roslens.source.forge.answers import Answer, Answers
from roslens.source.forge.forge_error import ForgeError
from roslens.source.forge.forge_place import KNOWN, Forge, ForgeKind

if TYPE_CHECKING:
    import httpx

TRIES = 3
LONGEST_WAIT_S = 60.0
"""If a forge requires a longer wait, it is a failure that states until when."""
LARGEST_ANSWER = 20_000_000
_LIMIT_S = 20.0
_FAULTS = frozenset({500, 502, 503, 504})
_HEADERS = ("link", "x-total", "x-total-count", "x-next-page")
_TOKENS = {
    ForgeKind.GITHUB: ("GITHUB_TOKEN", "GH_TOKEN"),
    ForgeKind.GITLAB: ("GITLAB_TOKEN",),
    ForgeKind.GITEA: ("GITEA_TOKEN",),
}
_CODEBERG = ("CODEBERG_TOKEN",)


class Reported(msgspec.Struct, frozen=True):
    """An answer: its document, and headers of use by their names in small letters."""

    document: Any
    headers: Mapping[str, str]


class ForgeClient:
    """Asks one forge; a context manager.

    A token is sent to the forge's own address only, never where it redirects to.
    """

    def __init__(
        self,
        forge: Forge,
        answers: Answers,
        *,
        environment: Mapping[str, str],
        offline: bool = False,
        sleep: Callable[[float], None] = time.sleep,
        now: Callable[[], float] = time.time,
    ) -> None:
        """Take what is asked, and how.

        Args:
            forge: that is asked.
            answers: kept ones.
            environment: holds the token: ``GITHUB_TOKEN`` or ``GH_TOKEN``, ``GITLAB_TOKEN``, ``GITEA_TOKEN``,
                of codeberg.org ``CODEBERG_TOKEN``.
            offline: whether only kept answers are given.
            sleep: waits for seconds.
            now: seconds since 1970.
        """
        self._forge = forge
        self._answers = answers
        # A token for one's own server is no business of a public one.
        self._names = _CODEBERG if forge == KNOWN["codeberg.org"] else _TOKENS[forge.kind]
        self._token = next((value for name in self._names if (value := environment.get(name, "").strip())), "")
        self._offline = offline
        self._sleep = sleep
        self._now = now
        self._client: httpx.Client | None = None

    def __enter__(self) -> ForgeClient:
        """Return the client itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close connections."""
        if self._client is not None:
            self._client.close()

    def get(self, path: str) -> Reported:
        """Return what is at an address below the forge's.

        Raises:
            ForgeError: it does not answer, or not as its interface says.
        """
        url = f"{self._forge.api}{path}"
        kept = self._answers.last(url)
        if self._offline:
            if kept is None:
                raise ForgeError(
                    f"{url} has no cached response, and --offline contacts no server", "Leave out --offline once"
                )
            return _reported(kept)
        status, headers, body = self._patiently(url, kept)
        if status == 304 and kept is not None:
            return _reported(kept)
        answer = Answer(headers.get("etag", ""), {one: headers[one] for one in _HEADERS if one in headers}, body)
        reported = _reported(answer)
        self._answers.keep(url, answer)
        return reported

    def _patiently(self, url: str, kept: Answer | None) -> tuple[int, Mapping[str, str], bytes]:
        """Ask until there is an answer, a few times."""
        said = ""
        for turn in range(TRIES):
            try:
                status, headers, body = self._once(url, kept)
            except OSError as error:
                said, wait = str(error), 2.0**turn
            else:
                if status in (200, 304):
                    return status, headers, body
                said, wait = f"answers {status}", self._pause(url, status, headers, body, turn)
            if turn < TRIES - 1:
                self._sleep(wait)
        raise ForgeError(f"{url} {said}, {TRIES} times", _again(url, said))

    def _pause(self, url: str, status: int, headers: Mapping[str, str], body: bytes, turn: int) -> float:
        """Return for how many seconds to wait after an answer that is none.

        Raises:
            ForgeError: it would be too long, or to ask again would not help.
        """
        if status == 429 or (status == 403 and _is_limit(headers)):
            wait = self._wait(headers)
            if wait > LONGEST_WAIT_S:
                raise ForgeError(
                    f"{url} answers {status}: its rate limit is reached for {wait:.0f} s more", self._advice()
                )
            return wait
        if status in _FAULTS:
            return 2.0**turn
        raise _refused(url, status, body, self._advice(), has_token=bool(self._token))

    def _once(self, url: str, kept: Answer | None) -> tuple[int, Mapping[str, str], bytes]:
        import httpx

        headers = {"If-None-Match": kept.etag} if kept is not None and kept.etag else {}
        if self._client is None:
            self._client = httpx.Client(
                headers=self._headers(), timeout=_LIMIT_S, follow_redirects=False, trust_env=True, verify=True
            )
        try:
            with self._client.stream("GET", url, headers=headers) as response:
                body = bytearray()
                for part in response.iter_bytes():
                    body += part
                    if len(body) > LARGEST_ANSWER:
                        raise ForgeError(f"{url} answers with more than {LARGEST_ANSWER:,} bytes")
                return response.status_code, response.headers, bytes(body)
        except httpx.HTTPError as error:
            raise OSError(f"does not answer: {type(error).__name__}: {error}") from error

    def _headers(self) -> dict[str, str]:
        headers = {"Accept": "application/json", "User-Agent": "roslens"}
        if self._forge.kind is ForgeKind.GITHUB:
            headers |= {"Accept": "application/vnd.github+json", "X-GitHub-Api-Version": "2022-11-28"}
        if not self._token:
            return headers
        if self._forge.kind is ForgeKind.GITLAB:
            return {**headers, "PRIVATE-TOKEN": self._token}
        word = "Bearer" if self._forge.kind is ForgeKind.GITHUB else "token"
        return {**headers, "Authorization": f"{word} {self._token}"}

    def _wait(self, headers: Mapping[str, str]) -> float:
        """Return how many seconds the forge asks to wait for."""
        after = headers.get("retry-after", "")
        if after.isdigit():
            return float(after)
        reset = headers.get("x-ratelimit-reset") or headers.get("ratelimit-reset") or ""
        return max(1.0, float(reset) - self._now()) if reset.isdigit() else 10.0

    def _advice(self) -> str:
        if self._token:
            return "Try again later"
        return f"Give a token in {self._names[0]}, or try again later"


def _again(url: str, complaint: str) -> str:
    """Return what to do about a forge that gave no answer."""
    if "WRONG_VERSION_NUMBER" in complaint.upper():
        parts = urlsplit(url)
        return (
            f"{parts.netloc} was asked by https, which it does not speak there; if it speaks only http, give "
            f"--forge-host http://{parts.netloc}=KIND"
        )
    return "Try again later; responses so far are kept"


def _is_limit(headers: Mapping[str, str]) -> bool:
    remaining = headers.get("x-ratelimit-remaining") or headers.get("ratelimit-remaining")
    return remaining == "0" or "retry-after" in headers


def _refused(url: str, status: int, body: bytes, advice: str, *, has_token: bool) -> ForgeError:
    if status == 401:
        return ForgeError(f"{url} answers 401: the token is not accepted", "Give another one")
    # The search of GitHub responds so for a repository that does not exist or is private.
    if status == 404 or (status == 422 and b"cannot be searched" in body):
        lacks = "" if has_token else ", or it is private and needs a token"
        reported = f"{url} answers {status}: there is no such repository{lacks}"
        return ForgeError(reported, advice if not has_token else "")
    if 300 <= status < 400:
        return ForgeError(f"{url} answers {status}: the repository has moved", "Correct the address of `origin`")
    return ForgeError(f"{url} answers {status}", advice)


def _reported(answer: Answer) -> Reported:
    try:
        return Reported(json.loads(answer.body), answer.headers)
    except (ValueError, RecursionError) as error:
        raise ForgeError(f"the response is not JSON: {error}", "Try again later") from error
