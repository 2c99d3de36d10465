"""Links of a repository that lead out of its folder: they are taken away, so that nothing outside is ever read."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path


def remove_leaving(folder: Path, links: Iterable[str]) -> list[str]:
    """Remove those of the ``links`` that lead out of ``folder``, through other links too; return their paths.

    Args:
        folder: of the clone.
        links: paths below it.
    """
    top = os.path.realpath(folder)
    gone = []
    for path in links:
        place = folder / path
        if not place.is_symlink():
            continue
        end = os.path.realpath(place)
        if end != top and not end.startswith(top + os.sep):
            place.unlink()
            gone.append(path)
    return gone
