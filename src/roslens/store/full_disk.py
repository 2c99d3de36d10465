"""Which file system is full: an error of the system names the file at best, and often one elsewhere."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

LEAST_BYTES = 1_000_000
"""Where so little is left, it is full."""


def full_file_system(paths: Iterable[Path | str]) -> str:
    """Return where the first full file system is mounted that holds one of ``paths`` or temporary files, or nothing.

    What is free only to the administrator does not count, as for the one who writes.
    """
    for path in (*paths, tempfile.gettempdir()):
        place = _nearest(Path(path))
        try:
            found = os.statvfs(place)
        except (OSError, AttributeError):
            continue
        no_room = found.f_blocks and found.f_bavail * found.f_frsize < LEAST_BYTES
        no_names = found.f_files and not found.f_favail
        if no_room or no_names:
            return (
                f"{_mount(place)} ({found.f_bavail * found.f_frsize:,} bytes are free)"
                if no_room
                else (f"{_mount(place)} (it takes no more files)")
            )
    return ""


def _nearest(path: Path) -> Path:
    path = path.absolute()
    return next((place for place in (path, *path.parents) if place.exists()), path)


def _mount(place: Path) -> Path:
    return next((one for one in (place, *place.parents) if one.is_mount()), place)
