"""Submodules of a checkout that are fetched, each at the commit that the checkout records of it."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from urllib.parse import urlsplit, urlunsplit

import msgspec

from roslens.intake.is_there import is_file
from roslens.source.fetch.git_runner import GitError, GitRunner
from roslens.source.fetch.index_entries import Entries
from roslens.source.fetch.urls import UrlError, checked, rewritten

MOST_LEVELS = 8
"""Submodules in submodules; what has more contains itself."""

_NAMES = ".gitmodules"


class SubmoduleSettings(msgspec.Struct, frozen=True):
    """Where submodules are fetched from.

    Attributes:
        rewrites: prefixes of URLs, and what takes their place.
        files: whether a repository may name folders of this machine.
        level: how many repositories this one is in.
    """

    rewrites: Mapping[str, str] = {}
    files: bool = False
    level: int = 0


class Submodule(msgspec.Struct, frozen=True):
    """A submodule: its path, the commit that is recorded, and the URL it is fetched from."""

    path: str
    commit: str
    url: str


def submodules_of(
    git: GitRunner, place: Path, url: str, entries: Entries, settings: SubmoduleSettings
) -> Iterator[Submodule]:
    """Yield the submodules of a checkout.

    Args:
        git: reads ``.gitmodules``.
        place: folder of the checkout.
        url: that it was fetched from.
        entries: links and submodules of the checkout.
        settings: where submodules are fetched from.

    Raises:
        GitError: one has no URL, none that may be fetched from, or is nested too deeply.
    """
    if not entries.submodules:
        return
    if settings.level >= MOST_LEVELS:
        raise GitError(f"submodules are nested more than {MOST_LEVELS} deep")
    named = _named(git, place)
    for path, commit in entries.submodules:
        if path not in named:
            raise GitError(f"the submodule at {path} has no URL in {_NAMES}")
        given = rewritten(_absolute(named[path], url), settings.rewrites)
        try:
            place_of = checked(given, files=settings.files or given != _absolute(named[path], url))
        except UrlError as error:
            raise GitError(f"the submodule at {path}: {error}") from error
        if not _is_inside(place, path):
            raise GitError(f"the submodule at {path} leads out of the repository")
        yield Submodule(path, commit, place_of)


def _named(git: GitRunner, place: Path) -> dict[str, str]:
    """Return the URLs of submodules by path."""
    file = place / _NAMES
    if file.is_symlink() or not is_file(file):
        return {}
    reported = git.ask(str(place), "config", "--file", str(file), "--list", "-z") or ""
    tables: dict[str, dict[str, str]] = {}
    for entry in reported.split("\0"):
        key, _, value = entry.partition("\n")
        section, _, last = key.rpartition(".")
        if section.startswith("submodule."):
            tables.setdefault(section, {})[last] = value
    return {table["path"]: table["url"] for table in tables.values() if table.get("path") and table.get("url")}


def _absolute(url: str, base: str) -> str:
    """Return the URL of a submodule, which may be relative to that of the repository that it is in."""
    if not url.startswith(("./", "../")):
        return url
    parts = urlsplit(base)
    path = PurePosixPath(os.path.normpath(f"{parts.path.rstrip('/')}/{url}"))
    return urlunsplit((parts.scheme, parts.netloc, str(path), "", ""))


def _is_inside(place: Path, path: str) -> bool:
    top, real = os.path.realpath(place), os.path.realpath(place / path)
    return real == os.path.normpath(f"{top}/{path}") and not os.path.islink(place / path)  # noqa: PTH114
