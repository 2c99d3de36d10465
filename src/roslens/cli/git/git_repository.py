"""A git repository that is looked at; nothing is checked out, fetched or run."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import msgspec

from roslens.children.git import git_environment, git_words, looks_bare
from roslens.model.errors import UsageError


class Repository(msgspec.Struct, frozen=True):
    """A git repository and the folder in it that is looked at.

    Attributes:
        root: folder of its files.
        below: the folder that is looked at, below ``root``; empty or ending with ``/``.
        folder: in which git keeps it; that of a submodule is one of its own.
        objects: folders with further objects, of submodules, which git reads as its own.
        within: where it is a submodule, the folder of the repository through which git is asked.
    """

    root: str
    below: str = ""
    folder: str = ""
    objects: tuple[str, ...] = ()
    within: str = ""

    @property
    def asked(self) -> str:
        """The folder in which git is run."""
        return self.within or self.root

    def environment(self) -> dict[str, str]:
        """Return the variables that git is run with."""
        return git_environment(os.environ, self.objects)

    def command(self, command: str, *arguments: str) -> list[str]:
        """Return the words that run a command of git on it."""
        return git_words(self.asked, command, *arguments)

    def git(self, command: str, *arguments: str) -> subprocess.CompletedProcess[bytes]:
        """Run git and return what it said.

        Raises:
            UsageError: git is not there, or does not answer.
        """
        try:
            return subprocess.run(
                self.command(command, *arguments), capture_output=True, timeout=60, check=False, env=self.environment()
            )
        except FileNotFoundError as error:
            raise UsageError("git is not installed", expected="git, to read revisions", advice="Install git") from error
        except subprocess.TimeoutExpired as error:
            raise UsageError(
                f"git did not answer in {error.timeout:g} s", expected="a repository that can be read"
            ) from error


def repository_of(path: str) -> Repository:
    """Return the repository that a folder is in.

    Raises:
        UsageError: it is in none, or git cannot be run.
    """
    if bare := looks_bare(path):
        raise UsageError(
            f'"{bare}" looks like a bare git repository, whose configuration is not trusted',
            expected="a folder of a repository with files",
            advice="Give the folder of a clone as PATH",
        )
    done = Repository(path).git("rev-parse", "--show-toplevel", "--show-prefix", "--git-common-dir")
    if done.returncode:
        raise UsageError(
            f'"{path}" is in no git repository that can be read: {said(done)}',
            expected="revisions of one, or two launch files of the workspace",
            advice="Give the folder of a repository as PATH, or PACKAGE/FILE of launch files",
        )
    root, below, folder = os.fsdecode(done.stdout).rstrip("\n").split("\n")[-3:]
    return Repository(root, below, str(Path(path, folder).resolve()))


def commit_of_revision(repository: Repository, name: str) -> str:
    """Return the commit that a revision means; empty where there is none of that name."""
    done = repository.git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
    return done.stdout.decode("ascii", "replace").strip() if not done.returncode else ""


def is_unborn(repository: Repository) -> bool:
    """Return whether nothing was committed yet to the branch that is checked out."""
    return not commit_of_revision(repository, "HEAD")


def names_like(repository: Repository, name: str) -> list[str]:
    """Return branches and tags whose names are like this one, the best first."""
    import difflib

    done = repository.git("for-each-ref", "--format=%(refname:short)")
    return difflib.get_close_matches(name, ["HEAD", *os.fsdecode(done.stdout).split()], 3, 0.5)


def said(done: subprocess.CompletedProcess[bytes]) -> str:
    """Return what git complained about, in one line."""
    return " ".join(done.stderr.decode("utf-8", "replace").split()) or "git has no output"
