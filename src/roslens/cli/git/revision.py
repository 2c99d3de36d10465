"""A commit that a revision means, and the files of a workspace as it has them."""

from __future__ import annotations

import os
from pathlib import Path

import msgspec

from roslens.cli.git.git_repository import Repository, commit_of_revision, is_unborn, names_like, repository_of, said
from roslens.model.errors import UsageError


class Revision(msgspec.Struct, frozen=True):
    """A revision of the repository that a workspace is in.

    ``commit`` is the one that the work tree and the revision come from, so that what others changed since counts as no
    change of this one; ``name`` is as given.
    """

    repository: Repository
    name: str
    commit: str

    @property
    def title(self) -> str:
        """How it is called: its name and, unless that is it, the beginning of the commit."""
        return self.name if self.commit.startswith(self.name) else f"{self.name} ({self.commit[:10]})"


def revision_of(root: Path, name: str) -> Revision:
    """Return the revision.

    Raises:
        UsageError: the workspace is in no repository, or there is no such revision.
    """
    repository = repository_of(str(root))
    commit = commit_of_revision(repository, name)
    if not commit:
        near = names_like(repository, name)
        raise UsageError(
            f'git knows no revision "{name}" in {repository.root}',
            expected="a branch, a tag or a commit that is fetched",
            advice=f"Did you mean {', '.join(near)}?" if near else "In a shallow clone, fetch it first",
        )
    done = repository.git("rev-parse", f"{commit}...HEAD")
    bases = [line[1:] for line in done.stdout.decode("ascii", "replace").split() if line.startswith("^")]
    return Revision(repository, name, bases[0] if done.returncode == 0 and len(bases) == 1 else commit)


def blobs_of(revision: Revision) -> dict[str, str]:
    """Return git's hash of each file of the revision by its path below the folder that is looked at.

    Raises:
        UsageError: git does not have the list of files.
    """
    repository = revision.repository
    done = repository.git("ls-tree", "-r", "-z", "--full-tree", revision.commit, "--", repository.below or ".")
    if done.returncode:
        raise UsageError(f'git cannot list the files of "{revision.name}": {said(done)}', expected="a full clone")
    found = {}
    for line in done.stdout.split(b"\0"):
        facts, _, path = line.partition(b"\t")
        if path and len(words := facts.split()) == 3:
            found[os.fsdecode(path)[len(repository.below) :]] = words[2].decode("ascii")
    return found


def committed_blobs(root: Path, name: str) -> dict[str, str]:
    """Return what `blobs_of` does of a revision by its name; no files for HEAD while nothing is committed yet.

    Raises:
        UsageError: the workspace is in no repository, there is no such revision, or git cannot list its files.
    """
    if name == "HEAD" and is_unborn(repository_of(str(root))):
        return {}
    return blobs_of(revision_of(root, name))


def renamed_since(revision: Revision) -> dict[str, str]:
    """Return the path that each renamed file has at HEAD by that in the revision.

    Raises:
        UsageError: git cannot be run.
    """
    from roslens.cli.git.git_renames import renamed_files

    return renamed_files(revision.repository, revision.commit, "HEAD")
