"""Files without a language that shape what rules find in a package: how it is installed, and how it is started."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from roslens.intake.bounded_file import read_bounded
from roslens.source.keys import content_hash
from roslens.source.workspace.command_texts import command_texts
from roslens.source.workspace.find import FoundPackage

PACKAGING_FILES = ("setup.cfg", "pyproject.toml")
"""Files at the top of a package that have no language and shape what rules find."""


def packaging(found: FoundPackage, root: str, *, is_launched: bool) -> list[tuple[str, str]]:
    """Return the hashes of files without a language that define how a package is installed or started.

    Args:
        found: the package.
        root: of the workspace.
        is_launched: whether it has launch files that a command line may pass arguments to.
    """
    read = [
        Path(found.folder, name)
        for entry in found.files
        if (name := entry.path.rpartition("/")[2]) in PACKAGING_FILES and "/" not in _inside(found, entry.path)
    ]
    if is_launched:
        paths = (entry.path for entry in found.files)
        read.extend(Path(root, path) for path in command_texts(root, found.package.path, paths))
    held: list[tuple[str, str]] = []
    for path in read:
        with suppress(OSError):
            held.append((path.name, content_hash(read_bounded(path))))
    return held


def _inside(found: FoundPackage, path: str) -> str:
    return path.removeprefix(f"{found.package.path}/")
