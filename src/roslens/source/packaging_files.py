"""The files of a package that say how it is installed."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from roslens.intake.bounded_file import read_bounded
from roslens.source.keys import content_hash
from roslens.source.workspace.find import FoundPackage

PACKAGING_FILES = ("setup.cfg", "pyproject.toml")
"""Files at the top of a package that have no language and shape what rules find."""


def packaging(found: FoundPackage) -> list[tuple[str, str]]:
    """Return the hashes of files that have no language and say how a package is installed."""
    read = [
        Path(found.folder, name)
        for entry in found.files
        if (name := entry.path.rpartition("/")[2]) in PACKAGING_FILES and "/" not in _inside(found, entry.path)
    ]
    held: list[tuple[str, str]] = []
    for path in read:
        with suppress(OSError):
            held.append((path.name, content_hash(read_bounded(path))))
    return held


def _inside(found: FoundPackage, path: str) -> str:
    return path.removeprefix(f"{found.package.path}/")
