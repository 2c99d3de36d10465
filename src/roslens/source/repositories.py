"""The repositories that the packages of a workspace are in."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path
from posixpath import basename

import msgspec

from roslens.children.git import git_environment, git_words, looks_bare
from roslens.model.repository import FoundRepository
from roslens.model.source import OUTSIDE_PACKAGES, SourceFile
from roslens.source.commit import commit_of
from roslens.source.fetch.fetched_set import FetchedSet
from roslens.source.fetch.urls import without_password
from roslens.source.workspace.find import Workspace

_LIMIT_S = 20.0


def repositories_of(
    workspace: Workspace, files: Mapping[str, tuple[SourceFile, ...]], fetched: FetchedSet
) -> tuple[FoundRepository, ...]:
    """Return the repositories, by path; packages that are in none make none.

    Args:
        workspace: where packages are.
        files: of each package, by its id.
        fetched: what the lock says of them.
    """
    packages: dict[str, list[str]] = {}
    for found in workspace.packages:
        path = _top(workspace.root, found.package.path) if found.package.id != OUTSIDE_PACKAGES else None
        if path is not None:
            packages.setdefault(path, []).append(found.package.id)
    return tuple(_described(workspace.root, path, ids, files, fetched) for path, ids in sorted(packages.items()))


def _top(root: str, path: str) -> str | None:
    """Return the folder with ``.git`` that a package is in, below the root; None for none."""
    folder = Path(root, path)
    while True:
        if os.path.lexists(folder / ".git"):
            return folder.relative_to(root).as_posix()
        if str(folder) == root or folder == folder.parent:
            return None
        folder = folder.parent


def _described(
    root: str, path: str, ids: list[str], files: Mapping[str, tuple[SourceFile, ...]], fetched: FetchedSet
) -> FoundRepository:
    top = root if path == "." else f"{root}/{path}"
    before = "" if path == "." else f"{path}/"
    own = (
        msgspec.structs.replace(file, path=file.path.removeprefix(before))
        for one in ids
        for file in files.get(one, ())
        if file.path.startswith(before)
    )
    taken = fetched.taken.get(path)
    return FoundRepository(
        path if taken else basename(path if path != "." else root),
        path,
        tuple(sorted(ids)),
        commit_of(top, own),
        taken.wanted.url if taken else _url(top),
        (taken.wanted.branch or taken.wanted.version) if taken else "",
    )


def _url(top: str) -> str:
    if looks_bare(top):
        return ""
    try:
        done = subprocess.run(
            git_words(top, "config", "--get", "remote.origin.url"), capture_output=True, timeout=_LIMIT_S, check=False,
            stdin=subprocess.DEVNULL, env=git_environment(os.environ),
        )  # fmt: skip
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return without_password(done.stdout.decode("utf-8", "replace").strip()) if done.returncode == 0 else ""
