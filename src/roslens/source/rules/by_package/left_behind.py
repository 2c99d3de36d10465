"""Folders of what is no longer used, as their names say: what is found there is a note."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit

_LEFT = re.compile(
    r"old|legacy|deprecated|obsolete|unused|archived?|graveyard|attic|not_for_build|do_not_use", re.IGNORECASE
)


def as_notes_where_left_behind(placed: Mapping[str, Sequence[Hit]]) -> dict[str, list[Hit]]:
    """Return hits by path; those below a folder of what is no longer used are notes."""
    return {path: _notes(hits) if is_left_behind(path) else list(hits) for path, hits in placed.items()}


def _notes(hits: Sequence[Hit]) -> list[Hit]:
    return [msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) for hit in hits]


def is_left_behind(path: str) -> bool:
    """Return whether a file lies below a folder of what is no longer used."""
    return any(_LEFT.fullmatch(folder) for folder in path.split("/")[:-1])
