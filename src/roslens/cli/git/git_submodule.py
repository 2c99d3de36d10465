"""Where the objects of a submodule are, if they are on this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from roslens.cli.git.git_repository import Repository
from roslens.intake.bounded_file import read_bounded


def submodule_at(repository: Repository, commit: str, path: str, wanted: str) -> Repository | None:
    """Return the submodule at ``path`` of a commit, if the commit ``wanted`` of it is on this machine.

    Looked for in its own checkout, and in the folder ``modules`` of the repository, where git keeps a submodule that
    is not checked out now, or was moved.

    Args:
        repository: that has the submodule.
        commit: of the repository.
        path: of the submodule below the repository's root.
        wanted: the commit of the submodule.
    """
    root = Path(repository.root, path)
    for folder in _folders(repository, commit, path):
        if (folder / "objects").is_dir():
            found = Repository(str(root), "", str(folder), (str(folder / "objects"),), repository.asked)
            if not found.git("cat-file", "-e", f"{wanted}^{{commit}}").returncode:
                return found
    return None


def _folders(repository: Repository, commit: str, path: str) -> Iterator[Path]:
    """Yield the folders in which git may keep the submodule."""
    kept = Path(repository.root, path, ".git")
    if kept.is_dir():
        yield kept
    elif kept.is_file():
        with_dots = kept.parent / os.fsdecode(read_bounded(kept)).partition("gitdir:")[2].strip()
        yield Path(os.path.normpath(with_dots))
    for name in dict.fromkeys((_name(repository, commit, path), path)):
        if name and not {"", ".", ".."}.intersection(name.split("/")):
            yield Path(repository.folder, "modules", name)


def _name(repository: Repository, commit: str, path: str) -> str:
    """Return the submodule's name, which it keeps where it is moved; empty if it is unknown."""
    reported = repository.git(
        "config", "--blob", f"{commit}:.gitmodules", "-z", "--get-regexp", r"^submodule\..*\.path$"
    )
    for line in os.fsdecode(reported.stdout).split("\0"):
        key, _, value = line.partition("\n")
        if value == path:
            return key.removeprefix("submodule.").removesuffix(".path")
    return ""
