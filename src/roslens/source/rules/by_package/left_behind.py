"""Folders of what is no longer used, as their names say: what is found there is a note."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.finding import Severity
from roslens.source.rules.hit import Hit

_LEFT = re.compile(r"old|deprecated|obsolete|unused|archived?|not_for_build|do_not_use", re.IGNORECASE)


def as_notes_where_left_behind(placed: Mapping[str, Sequence[Hit]]) -> dict[str, list[Hit]]:
    """Return hits by path; those below a folder of what is no longer used are notes."""
    return {
        path: [msgspec.structs.replace(hit, severity=Severity.NOTE) for hit in hits] if _is_left(path) else list(hits)
        for path, hits in placed.items()
    }


def _is_left(path: str) -> bool:
    return any(_LEFT.fullmatch(folder) for folder in path.split("/")[:-1])
