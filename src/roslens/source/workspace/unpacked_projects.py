"""Folders with a project that others published: unpacked archives, and libraries for Arduino.

What lies in a folder makes it a candidate, and whom it names decides. An archive of a branch is unpacked into
``name-branch``, and a project in it has a text to read first beside its licence or its build. A library for Arduino has
``library.properties`` or ``keywords.txt``, or ``examples`` with sketches. Either is of others where it says who made
it, and names nobody and nothing of the workspace; one that names its own people, packages or repository is its own,
and so is one that does not say whose it is.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence, Set

_DISTRIBUTION = (
    r"(?:hydro|indigo|jade|kinetic|lunar|melodic|noetic|dashing|eloquent|foxy|galactic|humble|iron|jazzy|kilted|lyrical"
    r"|rolling|ros[12])"
)
_UNPACKED = re.compile(
    rf"(.+?)-(?:master|main|develop|devel|trunk|[0-9a-f]{{40}}|{_DISTRIBUTION}(?:[-_]devel)?)", re.IGNORECASE
)
"""A folder that an archive of a branch, or of a commit, is unpacked into, with the name of the project."""

_READ_FIRST = re.compile(r"readme(?:\.\w+)?", re.IGNORECASE)
_PROJECT = re.compile(
    r"(?:un)?licen[cs]e(?:[-_.][\w.-]*)?|copying(?:[-_.][\w.-]*)?|authors(?:\.\w+)?|cmakelists\.txt|makefile(?:\.am)?"
    r"|configure(?:\.ac)?|meson\.build|setup\.(?:py|cfg)|pyproject\.toml|package\.json|cargo\.toml|library\.properties"
    r"|doxyfile",
    re.IGNORECASE,
)
_LIBRARY = frozenset(("library.properties", "keywords.txt"))
_HEADER = re.compile(r".+\.(?:h|hh|hpp)", re.IGNORECASE)
_SKETCH = re.compile(r"(.+)/examples/(?:.+/)?[^/]+\.(?:ino|pde)", re.IGNORECASE)
_PAPERS = re.compile(
    r"readme.*|(?:un)?licen[cs]e.*|copying.*|authors.*|library\.(?:properties|json)|setup\.py|pyproject\.toml"
    r"|package\.json",
    re.IGNORECASE,
)
_MOST_PAPERS = 8
_MOST_HEADERS = 3
_HEAD = 4096
_ATTRIBUTED = re.compile(
    r"copyright|\(c\)|©|\b(?:author|maintainer|credit)s?\b|\b(?:written|created|made|developed|maintained) by\b"
    r"|(?:github|gitlab)\.com/\w",
    re.IGNORECASE,
)
_LEAST_NAME = 4
"""Letters of a name that is looked for in what a project says of itself: shorter ones are in many words."""


def unpacked_project(folder: str) -> str:
    """Return the project of an archive that a folder is named after, ``driver`` of ``driver-master``; else nothing."""
    found = _UNPACKED.fullmatch(folder)
    return found[1] if found else ""


def unpacked_projects(
    package: str, paths: Sequence[str], own: Set[str], read: Callable[[str], bytes], around: Iterable[str] = ()
) -> tuple[str, ...]:
    """Return the folders of a package with projects of others, each with ``/`` at its end.

    Args:
        package: its folder below the workspace root, ``.`` or empty for that itself: never one of them.
        paths: of all its files, below the workspace root.
        own: names of people, packages and repositories of the workspace, in lower case.
        read: returns the first bytes of a file of the package.
        around: folders of packages; a folder around one of them is judged with that.
    """
    start = "" if package in ("", ".") else f"{package}/"
    inside: dict[str, list[str]] = {}
    sketches = set()
    for path in paths:
        folder, _, file = path.rpartition("/")
        inside.setdefault(folder, []).append(file)
        if sketch := _SKETCH.fullmatch(path):
            sketches.add(sketch[1])
    found: list[str] = []
    for folder in sorted(inside):
        if not folder.startswith(start) or folder in ("", package) or f"{folder}/".startswith(tuple(found)):
            continue
        if any(f"{one}/".startswith(f"{folder}/") for one in around):
            continue
        if not (_is_archive(folder, inside[folder], own) or _is_library(folder, inside[folder], sketches)):
            continue
        if _is_of_others(folder, inside, own, read):
            found.append(f"{folder}/")
    return tuple(found)


def _is_archive(folder: str, files: Sequence[str], own: Set[str]) -> bool:
    unpacked = _UNPACKED.fullmatch(folder.rpartition("/")[2])
    if unpacked is None or unpacked[1].lower() in own:
        return False
    return any(map(_READ_FIRST.fullmatch, files)) and any(map(_PROJECT.fullmatch, files))


def _is_library(folder: str, files: Sequence[str], sketches: Set[str]) -> bool:
    return not _LIBRARY.isdisjoint(files) or (folder in sketches and any(map(_HEADER.fullmatch, files)))


def _is_of_others(
    folder: str, inside: Mapping[str, Sequence[str]], own: Set[str], read: Callable[[str], bytes]
) -> bool:
    """Return whether a project says who made it, and names nothing of the workspace."""
    files = inside[folder]
    papers = [file for file in files if _PAPERS.fullmatch(file)][:_MOST_PAPERS]
    headers = [file for file in files if _HEADER.fullmatch(file)]
    headers = headers or [f"src/{file}" for file in inside.get(f"{folder}/src", ()) if _HEADER.fullmatch(file)]
    text = "\n".join(
        read(f"{folder}/{file}")[:_HEAD].decode("utf-8", "replace") for file in (*papers, *headers[:_MOST_HEADERS])
    )
    if not _ATTRIBUTED.search(text):
        return False
    lower = text.lower()
    return not any(_names(lower, name) for name in own if len(name) >= _LEAST_NAME)


def _names(text: str, name: str) -> bool:
    """Return whether a text has a name as words of its own."""
    return name in text and re.search(rf"(?<![^\W_]){re.escape(name)}(?![^\W_])", text) is not None
