"""The repositories below a folder: clones, bare ones too, by the name ``owner/name`` that their folder says."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import msgspec


class Repository(msgspec.Struct, frozen=True):
    """A clone, its name and the commit that is checked out."""

    name: str
    clone: Path
    commit: str


def repositories(folder: Path) -> Iterator[Repository]:
    """Yield the clones below a folder, sorted by name.

    A clone is ``owner+name`` or ``owner__name`` (else its name is that of its folder), or ``owner/name``; it may lie in
    a folder ``repo`` below.
    """
    found = {}
    for outer in sorted(folder.iterdir()):
        if (clone := _clone(outer)) is not None:
            found[outer.name.replace("+", "/", 1).replace("__", "/", 1)] = clone
        elif outer.is_dir():
            found |= {f"{outer.name}/{one.name}": clone for one in outer.iterdir() if (clone := _clone(one))}
    for name, clone in sorted(found.items()):
        command = ["git", "-C", str(clone), "rev-parse", "HEAD"]
        said = subprocess.run(command, capture_output=True, text=True, check=False)
        if said.returncode == 0:
            yield Repository(name, clone, said.stdout.strip())


def _clone(folder: Path) -> Path | None:
    """Return where the git data of a folder are; None where it is no clone."""
    for place in (folder, folder / "repo", folder / "repo" / ".git"):
        if (place / ".git").exists() or ((place / "HEAD").is_file() and (place / "objects").is_dir()):
            return place.resolve()
    return None
