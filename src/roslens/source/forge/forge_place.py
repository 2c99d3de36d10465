"""Where a repository is kept: which forge, under which name."""

from __future__ import annotations

import re
from collections.abc import Mapping
from enum import Enum
from urllib.parse import urlsplit

import msgspec


class ForgeKind(str, Enum):
    """The forges whose interfaces are known."""

    GITHUB = "github"
    GITLAB = "gitlab"
    GITEA = "gitea"


class Forge(msgspec.Struct, frozen=True):
    """A forge: its kind and the address that its interface starts from, without a slash at the end."""

    kind: ForgeKind
    api: str


class ForgePlace(msgspec.Struct, frozen=True):
    """A repository on a forge: ``name`` is ``owner/name``, on GitLab with all groups."""

    forge: Forge
    name: str


KNOWN = {
    "github.com": Forge(ForgeKind.GITHUB, "https://api.github.com"),
    "gitlab.com": Forge(ForgeKind.GITLAB, "https://gitlab.com/api/v4"),
    "codeberg.org": Forge(ForgeKind.GITEA, "https://codeberg.org/api/v1"),
    "gitea.com": Forge(ForgeKind.GITEA, "https://gitea.com/api/v1"),
}
"""Forges that are asked by their names; any other host has to be named by the user."""

_PATHS = {ForgeKind.GITHUB: "/api/v3", ForgeKind.GITLAB: "/api/v4", ForgeKind.GITEA: "/api/v1"}
_SHORT = re.compile(r"(?:[\w.-]+@)?(?P<host>[\w.-]+):(?P<path>(?!//)[^:]+)")
_NAME = re.compile(r"[\w.~-]+(?:/[\w.~-]+)+")


def given_forge(text: str) -> tuple[str, Forge]:
    """Read ``HOST=KIND`` or ``URL=KIND`` and return the host with its forge.

    Raises:
        ValueError: it is neither.
    """
    where, _, kind = text.rpartition("=")
    if not where or kind not in {one.value for one in ForgeKind}:
        raise ValueError(f"{text!r} is not HOST=github, HOST=gitlab or HOST=gitea")
    parts = urlsplit(where if "//" in where else f"https://{where}")
    if parts.scheme not in ("http", "https") or not parts.hostname or parts.username or parts.query:
        raise ValueError(f"{where!r} is neither a host nor its http address")
    known = ForgeKind(kind)
    return parts.hostname, Forge(known, f"{parts.scheme}://{parts.netloc}{parts.path.rstrip('/')}{_PATHS[known]}")


def place_of_url(url: str, forges: Mapping[str, Forge]) -> ForgePlace | None:
    """Return where the remote of a clone is kept; None where that is no forge of these.

    Args:
        url: as git has it: ``https://host/owner/name.git``, ``ssh://git@host/owner/name``, ``git@host:owner/name``.
        forges: by host.
    """
    host, path = _split(url)
    name = path.strip("/").removesuffix(".git")
    forge = forges.get(host)
    if forge is None or not _NAME.fullmatch(name) or ".." in name.split("/"):
        return None
    if forge.kind is not ForgeKind.GITLAB and name.count("/") != 1:
        return None
    return ForgePlace(forge, name)


def _split(url: str) -> tuple[str, str]:
    if "://" in url:
        try:
            parts = urlsplit(url)
            return (parts.hostname or "").lower(), parts.path if parts.scheme in ("https", "http", "ssh", "git") else ""
        except ValueError:
            return "", ""
    match = _SHORT.fullmatch(url)
    return (match["host"].lower(), match["path"]) if match else ("", "")
