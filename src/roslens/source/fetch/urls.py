"""Which URLs are fetched from, and how a mirror takes the place of a server."""

from __future__ import annotations

import re
from collections.abc import Mapping
from urllib.parse import urlsplit

from roslens.children.fetching_git import SCHEMES

_SCP = re.compile(r"(?P<user>[\w.-]+@)?(?P<host>[\w][\w.-]*):(?!//)(?P<path>[^:].*)\Z")
_CONTROL = re.compile(r"[\x00-\x20\x7f]")


class UrlError(ValueError):
    """A URL that cannot be fetched from; the text states why and what was expected."""


def rewritten(url: str, rewrites: Mapping[str, str]) -> str:
    """Return the URL with the longest prefix among ``rewrites`` replaced; as it is where none fits."""
    fitting = [prefix for prefix in rewrites if prefix and url.startswith(prefix)]
    if not fitting:
        return url
    longest = max(fitting, key=len)
    return rewrites[longest] + url[len(longest) :]


def checked(url: str, *, files: bool) -> str:
    """Return the URL in the form that git is given.

    Args:
        url: with a scheme, or as ``user@host:path``.
        files: whether folders of this machine may be meant.

    Raises:
        UrlError: it has another scheme, no host, or characters that no URL has.
    """
    if _CONTROL.search(url):
        raise UrlError(f"the URL {url!r} has a blank or a control character")
    if "://" not in url and (short := _SCP.match(url)):
        url = f"ssh://{short['user'] or ''}{short['host']}/{short['path'].removeprefix('/')}"
    try:
        parts = urlsplit(url)
        host = parts.hostname or ""
    except ValueError as error:
        raise UrlError(f"the URL {url!r} cannot be read, {error}") from error
    if parts.scheme not in SCHEMES:
        way = "; rewrite it to https in roslens.toml, [fetch.rewrite]" if parts.scheme == "git" else ""
        raise UrlError(f"the URL {url!r} is none of {', '.join(SCHEMES)}{way}")
    if parts.scheme == "file":
        _check_folder(url, host, parts.path, files=files)
    elif not host or host.startswith("-") or parts.path.startswith("/-"):
        raise UrlError(f"the URL {url!r} names no host")
    return url


def _check_folder(url: str, host: str, path: str, *, files: bool) -> None:
    if not files:
        raise UrlError(f"the URL {url!r} is a folder of this machine, in a document from elsewhere")
    if host or not path.startswith("/"):
        raise UrlError(f"the URL {url!r} names no absolute folder of this machine")


def is_local(url: str) -> bool:
    """Return whether no network is needed for a URL."""
    return url.startswith("file://")


def without_password(url: str) -> str:
    """Return the URL as it may be shown and written: without the password that some put into it."""
    try:
        parts = urlsplit(url)
    except ValueError:
        return url
    if not parts.password:
        return url
    return parts._replace(netloc=parts.netloc.replace(f":{parts.password}@", "@", 1)).geturl()
