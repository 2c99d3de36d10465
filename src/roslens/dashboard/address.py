"""Where each page lives: one reference, three ways to write it down (served, in a folder, in one file)."""

from __future__ import annotations

import re
from hashlib import blake2b
from typing import Protocol
from urllib.parse import quote, urlencode

import msgspec

_LONGEST_NAME = 120
# An underscore that begins what looks like an escape is itself escaped, so that no two names become one.
_UNSAFE = re.compile(r"[^A-Za-z0-9._+@-]|_(?=[0-9a-f]+_)")
_SUFFIX = re.compile(r"\.(?=(?:html|json|csv)\Z)")

PLACES = {
    "overview": "overview",
    "graph": "graph",
    "computation": "computation/",
    "node": "nodes/",
    "topic": "topics/",
    "packages": "packages",
    "package": "packages/",
    "file": "files/",
    "findings": "findings",
    "runs": "runs",
    "history": "history",
    "trend": "history/",
    "difference": "difference",
    "conformance": "conformance",
    "hotspots": "hotspots",
    "metrics": "metrics",
    "metric": "metrics/",
    "rules": "rules",
    "rule": "rules/",
    "failures": "failures",
    "search": "search",
    "entity": "entity",
    "help": "help",
}
"""Page to place; a place that ends with ``/`` holds one page per key."""


class PageRef(msgspec.Struct, frozen=True, omit_defaults=True):
    """A page, which one of its kind (``key``), what is asked of it and a place on it."""

    page: str
    key: str = ""
    query: tuple[tuple[str, str], ...] = ()
    anchor: str = ""


class Links(Protocol):
    """Writes references down so that the page ``here`` can follow them."""

    def to(self, ref: PageRef) -> str:
        """Return the address of a page."""

    def twin(self, ref: PageRef, suffix: str) -> str:
        """Return the address of the machine-readable twin with ``suffix`` (``json``, ``files.csv``); may be empty."""

    def asset(self, name: str) -> str:
        """Return the address of a file of ``web/``."""


class ServedLinks:
    """Absolute paths on the server."""

    def to(self, ref: PageRef) -> str:
        """Return path, query and fragment."""
        path = "/" if ref.page == "overview" else "/" + served_path(ref)
        return path + _query(ref.query) + _fragment(ref.anchor)

    def twin(self, ref: PageRef, suffix: str) -> str:
        """Return the page's path with the suffix, and its query."""
        return f"/{served_path(ref)}.{suffix}" + _query(ref.query)

    def asset(self, name: str) -> str:
        """Return a path below ``/web``."""
        return f"/web/{name}"


class FolderLinks:
    """Relative paths between the files of an exported folder, seen from the page ``here``."""

    def __init__(self, here: PageRef) -> None:
        """``here`` is the page on which the links will stand."""
        self._folders = folder_path(here, "html").split("/")[:-1]
        self._known: dict[tuple[str, str], str] = {}

    def to(self, ref: PageRef) -> str:
        """Return a relative path, the query (scripts read it) and the fragment."""
        if ref.page == "findings":
            ref = written(ref)
        place = self._known.get((ref.page, ref.key))
        if place is None:
            place = self._known[ref.page, ref.key] = self._relative(folder_path(ref, "html"))
        return place + _query(ref.query) + _fragment(ref.anchor)

    def twin(self, ref: PageRef, suffix: str) -> str:
        """Return the relative path of the twin; it holds everything, so no query."""
        return self._relative(folder_path(ref, suffix))

    def asset(self, name: str) -> str:
        """Return a relative path below ``web``."""
        return self._relative(f"web/{name}")

    def _relative(self, path: str) -> str:
        parts = path.split("/")
        shared = 0
        for own, other in zip(self._folders, parts[:-1], strict=False):
            if own != other:
                break
            shared += 1
        return quote("/".join([".."] * (len(self._folders) - shared) + parts[shared:]), safe="/@+")


class FileLinks:
    """Fragments inside one file. ``known`` are the sections that it has."""

    def __init__(self, known: frozenset[str]) -> None:
        """``known`` holds :func:`section_id` of every page in the file."""
        self._known = known

    def to(self, ref: PageRef) -> str:
        """Return a fragment; empty where the file has no such page."""
        ref = written(ref)
        section = section_id(ref)
        if section not in self._known:
            return ""
        if ref.page == "file" and ref.anchor:
            section = f"{section}:{ref.anchor}"
        return "#" + quote(section, safe="/@:+") + _query(ref.query)

    def twin(self, ref: PageRef, suffix: str) -> str:  # noqa: ARG002 - one file has no twins
        """Return nothing: a single file has no twins beside it."""
        return ""

    def asset(self, name: str) -> str:  # noqa: ARG002 - everything is inside
        """Return nothing: everything is inside."""
        return ""


def written(ref: PageRef) -> PageRef:
    """Return the page of a written report that answers what is asked of the findings page.

    A server filters all findings; a written page can only hide some of those it holds, and the page of a package, a
    rule or a file holds more of its own than the page of all.
    """
    if ref.page != "findings":
        return ref
    asked = dict(ref.query)
    for name, page in (("path", "file"), ("package", "package"), ("rule", "rule")):
        if asked.get(name):
            rest = tuple((key, value) for key, value in ref.query if key not in {"path", "package", name})
            return PageRef(page, asked[name], rest, ref.anchor or ("findings" if page != "file" else ""))
    return ref


def served_path(ref: PageRef) -> str:
    """Return the path on the server, without the leading ``/``."""
    place = PLACES[ref.page]
    return place + quote(ref.key, safe="/@:+") if place.endswith("/") else place


def section_id(ref: PageRef) -> str:
    """Return the id of the section that shows the page in a single file."""
    place = PLACES[ref.page]
    return place + ref.key if place.endswith("/") else place


def folder_path(ref: PageRef, suffix: str) -> str:
    """Return the path below the exported folder; keys become names that every file system takes."""
    place = PLACES[ref.page]
    if ref.page == "overview":
        return f"index.{suffix}" if suffix == "html" else f"overview.{suffix}"
    if not place.endswith("/"):
        return f"{place}.{suffix}"
    *folders, name = (_safe_name(part) for part in ref.key.split("/"))
    # A folder "a.html" would stand where the page of a file "a" must stand.
    parts = [*(_SUFFIX.sub("_2e_", folder) for folder in folders), name]
    return f"{place}{'/'.join(parts)}.{suffix}"


def _safe_name(part: str) -> str:
    safe = _UNSAFE.sub(lambda match: f"_{ord(match.group()):x}_", part)
    if safe.startswith("."):
        safe = "_2e_" + safe[1:]
    if len(safe) > _LONGEST_NAME:
        digest = blake2b(part.encode("utf-8", "surrogateescape"), digest_size=6).hexdigest()
        safe = f"{safe[: _LONGEST_NAME - 13]}_{digest}"
    return safe or "_"


def _query(query: tuple[tuple[str, str], ...]) -> str:
    given = [(key, value) for key, value in query if value] if query else None
    return "?" + urlencode(given) if given else ""


def _fragment(anchor: str) -> str:
    return "#" + quote(anchor, safe="/@:+") if anchor else ""
