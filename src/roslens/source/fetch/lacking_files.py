"""Files that a server names in a revision and does not have: those that are no source are left out, and reported."""

from __future__ import annotations

import re
from pathlib import Path

from roslens.model.source import Language
from roslens.source.fetch.git_runner import GitError, GitRunner
from roslens.source.workspace.languages import language_by_name

_NOT_THERE = re.compile(r"not our ref ([0-9a-f]{40,64})\b")
_MOST = 20
"""A server that lacks more is no mirror but a part of one."""


def write_files(git: GitRunner, folder: str, commit: str, *, local: bool) -> tuple[str, ...]:
    """Write the files of a commit, fetching what is not here yet; return the paths that the server does not have.

    A mirror may have left out a recording or a picture for its size. Without one of its sources a revision is not
    what it says, so that this is an error.

    Args:
        git: does it.
        folder: of the clone.
        commit: of which all but contents of files is here.
        local: whether the server is a folder of this machine.

    Raises:
        GitError: the server lacks a source, or too much, or cannot be reached.
    """
    words = ("read-tree", "--reset", "-u", "--no-recurse-submodules", commit)
    lacking: dict[str, None] = {}
    try:
        while True:
            try:
                git.over_network(folder, *words, local=local)
            except GitError as error:
                found = _paths(git, folder, commit, _NOT_THERE.findall(str(error)))
                if not found.difference(lacking) or len(lacking) >= _MOST:
                    raise
                _refuse_sources(found)
                lacking |= dict.fromkeys(sorted(found))
                _leave_out(git, folder, lacking)
            else:
                return tuple(lacking)
    finally:
        if lacking:
            git.ask(folder, "config", "--unset", "core.sparseCheckout")


def _paths(git: GitRunner, folder: str, commit: str, blobs: list[str]) -> set[str]:
    rows = git.do(folder, "ls-tree", "-r", "-z", commit).split("\0")
    return {row.partition("\t")[2] for row in rows if any(f" {blob}\t" in row for blob in blobs)}


def _refuse_sources(paths: set[str]) -> None:
    sources = sorted(path for path in paths if language_by_name(path) is not Language.OTHER)
    if sources:
        raise GitError(f"the server does not have the content of {sources[0]}; fetch from one that has all of it")


def _leave_out(git: GitRunner, folder: str, paths: dict[str, None]) -> None:
    """Have git treat the files as excluded from the checkout."""
    patterns = ("!/" + re.sub(r"([\\*?[])", r"\\\1", path) for path in paths)
    (Path(folder) / ".git" / "info" / "sparse-checkout").write_text("\n".join(("/*", *patterns, "")))
    git.do(folder, "config", "core.sparseCheckout", "true")
