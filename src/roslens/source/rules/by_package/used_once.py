"""Headers of one source: what they open, nobody else gets.

A header below ``src`` that nothing installs and one file includes is a part of that file.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import takewhile
from pathlib import PurePosixPath

import msgspec

from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import HEADER, Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.views.cmake_view import Written

_RULES = frozenset({"cpp.using_namespace"})
_FOLDER = "src/"


def as_notes_where_used_once(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; what a header hands on to whoever includes it is a note in a header of one source.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    return {
        path: [_as_note(hit) for hit in hits]
        if any(_is_asked(hit) for hit in hits) and _is_used_once(path, view)
        else list(hits)
        for path, hits in placed.items()
    }


def _is_asked(hit: Hit) -> bool:
    return hit.rule in _RULES and hit.only == HEADER


def _is_used_once(path: str, view: PackageView) -> bool:
    if view.package.id == OUTSIDE_PACKAGES or not view.inside(path).startswith(_FOLDER):
        return False
    name = PurePosixPath(path).name
    if any(_may_install(one, name) for one in view.cmake.named("install")):
        return False
    users = [other for other, facts in view.facts.items() if any(_names(one, name) for one, _ in facts.includes)]
    return len(users) == 1 and users != [path]


def _names(include: str, name: str) -> bool:
    return PurePosixPath(include.strip('<>"')).name == name


def _may_install(one: Written, name: str) -> bool:
    """Return whether a command installs files that may be a header: by its name, or all of a folder around it."""
    if not {"FILES", "DIRECTORY", "FILE_SET"} & set(one.words):
        return False
    installed = takewhile(lambda word: word != "DESTINATION", one.words)
    return any(
        name in word or "$" in word or word.rstrip("/") in ("src", ".", "") or _FOLDER in word for word in installed
    )


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if _is_asked(hit) else hit
