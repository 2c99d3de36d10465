"""The branch that a change is going to be merged into: what ``--baseline auto`` compares with."""

from __future__ import annotations

import os
from collections.abc import Mapping

from roslens.cli.git.git_repository import Repository, commit_of_revision
from roslens.model.errors import UsageError

AUTO = "auto"
"""Names it on the command line."""

COMMITS = ("CI_MERGE_REQUEST_DIFF_BASE_SHA",)
"""Variables of a CI that hold the commit itself: GitLab."""
BRANCHES = (
    "GITHUB_BASE_REF",
    "CI_MERGE_REQUEST_TARGET_BRANCH_NAME",
    "SYSTEM_PULLREQUEST_TARGETBRANCH",
    "BITBUCKET_PR_DESTINATION_BRANCH",
    "BUILDKITE_PULL_REQUEST_BASE_BRANCH",
    "CHANGE_TARGET",
    "DRONE_TARGET_BRANCH",
)
"""Variables that hold the branch: GitHub, Gitea and Forgejo, GitLab, Azure, Bitbucket, Buildkite, Jenkins, Drone."""


def merge_target(repository: Repository, environment: Mapping[str, str]) -> str:
    """Return the revision that a change will be merged into.

    In a CI that is what its variables say of the pull or merge request; elsewhere the default branch of the remote.

    Args:
        repository: with the change.
        environment: variables of the process.

    Raises:
        UsageError: a CI names a branch that was not fetched, or no remote says which branch is its default.
    """
    remotes = _remotes(repository)
    for variable in (*COMMITS, *BRANCHES):
        if name := environment.get(variable, "").removeprefix("refs/heads/"):
            return _fetched(repository, name, variable, remotes)
    for remote in remotes:
        done = repository.git("for-each-ref", "--format=%(symref:short)", f"refs/remotes/{remote}/HEAD")
        if head := os.fsdecode(done.stdout).strip():
            return head
    remote = remotes[0] if remotes else ""
    raise UsageError(
        f"--baseline {AUTO}: {_unknown(remote)}",
        expected="a remote with a known default branch, or the variables of a pull or merge request in a CI",
        advice=f"`git remote set-head {remote} --auto` asks it; or name the branch: --baseline {remote}/BRANCH"
        if remote
        else "Name a branch, a commit or a report: --baseline BRANCH",
    )


def _unknown(remote: str) -> str:
    return f"git does not know the default branch of remote {remote!r}" if remote else "the repository has no remote"


def _remotes(repository: Repository) -> list[str]:
    """Return the names of remotes: `origin`, which a clone makes, before others."""
    done = repository.git("config", "--name-only", "--get-regexp", r"^remote\..*\.url$")
    names = [line.removeprefix("remote.").removesuffix(".url") for line in os.fsdecode(done.stdout).splitlines()]
    return sorted(names, key=lambda name: (name != "origin", name))


def _fetched(repository: Repository, name: str, variable: str, remotes: list[str]) -> str:
    candidates = [*(f"{remote}/{name}" for remote in remotes), name]
    for candidate in candidates:
        if commit_of_revision(repository, candidate):
            return candidate
    remote = remotes[0] if remotes else "origin"
    raise UsageError(
        f"--baseline {AUTO}: {variable} names {name!r}, which is not in this clone",
        expected="a clone that has the target of the pull or merge request",
        advice=f"Fetch it first: git fetch --depth 50 {remote} {name}:refs/remotes/{remote}/{name}",
    )
