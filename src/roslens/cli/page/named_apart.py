"""Short names of files: the name of the file alone, with as much of the path before it as tells it from the others."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path


def named_apart(paths: Sequence[str | Path]) -> list[str]:
    """Return a name for each path: ``drive.mcap``, or ``monday/drive.mcap`` beside ``tuesday/drive.mcap``.

    The same path has the same name, however often it comes.
    """
    parts = [Path(os.path.abspath(path)).parts for path in paths]  # noqa: PTH100 - a link keeps its name
    return [str(Path(*one[-_length(one, parts) :])) if len(one) > 1 else one[0] for one in parts]


def _length(one: tuple[str, ...], all_parts: Sequence[tuple[str, ...]]) -> int:
    """Return how many of the last parts of a path no other path ends with."""
    others = [other for other in all_parts if other != one]
    whole = range(1, len(one))
    return next((length for length in whole if all(other[-length:] != one[-length:] for other in others)), len(one))
