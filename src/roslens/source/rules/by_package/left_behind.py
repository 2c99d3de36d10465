"""Folders and files of what is no longer used, and backups, as their names say: what is found there is a note."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit

_COPY = r".* ?\(copy(?: \d+)?\)|.* (?:- )?copy(?: \d+)?|copy of .*"
_LEFT = re.compile(
    r"old|archived?|archives|graveyard|attic|not_for_build|do_not_use"
    r"|(?:.*[ _-])?(?:legacy|deprecated|obsolete|unused|no_longer_used|backups?|bkup|bak|bkp)"
    rf"|(?:legacy|deprecated|obsolete|unused|bkup|bak)[ _-].*|.*[ _-]old|{_COPY}",
    re.IGNORECASE,
)
_COPIED = re.compile(_COPY, re.IGNORECASE)
_MARK = re.compile(
    r"^(?:old|bkup|bak|backup)[ _-]"
    r"|[ _-]?\((?:old|bkup|bak|backup|orig|original)\)(?=\.)"
    r"|[ _-](?:old(?:version)?|bkup|bak|bkp|backup|orig|original)\d*(?=\.)",
    re.IGNORECASE,
)
"""What marks a file as an earlier version of one that lies beside it; without that it may be a name like any other."""


def as_notes_where_left_behind(
    placed: Mapping[str, Sequence[Hit]], names: Set[str] = frozenset()
) -> dict[str, list[Hit]]:
    """Return hits by path; those of what is no longer used, and of backups, are notes.

    Args:
        placed: hits by path.
        names: of all files of the package, without their folders.
    """
    return {
        path: _notes(hits) if is_left_behind(path) or is_earlier(path, names) else list(hits)
        for path, hits in placed.items()
    }


def _notes(hits: Sequence[Hit]) -> list[Hit]:
    return [msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) for hit in hits]


def is_left_behind(path: str) -> bool:
    """Return whether a file lies below a folder of what is no longer used, or is a copy as file managers name it."""
    *folders, name = path.split("/")
    return _COPIED.fullmatch(name.partition(".")[0]) is not None or any(map(_LEFT.fullmatch, folders))


def is_earlier(path: str, names: Set[str]) -> bool:
    """Return whether a file is named as another one with a mark of what is kept: ``drive_old.py`` of ``drive.py``."""
    name = path.rpartition("/")[2]
    without = _MARK.sub("", name, count=1)
    return without != name and without in names
