"""What ``--baseline auto`` compares with: the target of a pull request, else the default branch of the remote."""

import os
import subprocess

import pytest

from roslens.cli.git.git_repository import repository_of
from roslens.cli.git.merge_target import merge_target
from roslens.model.errors import UsageError


def git(folder, *words):
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    environment = {**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"}
    command = ["git", "-C", str(folder), "-c", "init.defaultBranch=rolling", *words]
    subprocess.run(command, check=True, capture_output=True, env=environment)


@pytest.fixture
def clone(tmp_path):
    upstream = tmp_path / "upstream"
    upstream.mkdir()
    git(upstream, "init", "-q")
    git(upstream, "commit", "-q", "--allow-empty", "-m", "first")
    git(upstream, "branch", "humble")
    git(tmp_path, "clone", "-q", str(upstream), "clone")
    return tmp_path / "clone"


def test_the_default_branch_of_the_remote(clone):
    assert merge_target(repository_of(str(clone)), {}) == "origin/rolling"


def test_a_remote_of_another_name(clone):
    git(clone, "remote", "rename", "origin", "upstream")
    assert merge_target(repository_of(str(clone)), {}) == "upstream/rolling"


@pytest.mark.parametrize(
    ("variable", "value"),
    [
        ("GITHUB_BASE_REF", "humble"),
        ("CI_MERGE_REQUEST_TARGET_BRANCH_NAME", "humble"),
        ("SYSTEM_PULLREQUEST_TARGETBRANCH", "refs/heads/humble"),
        ("CHANGE_TARGET", "humble"),
    ],
)
def test_the_target_of_a_pull_request(clone, variable, value):
    assert merge_target(repository_of(str(clone)), {variable: value}) == "origin/humble"


def test_a_variable_that_is_empty_names_nothing(clone):
    assert merge_target(repository_of(str(clone)), {"GITHUB_BASE_REF": ""}) == "origin/rolling"


def test_a_target_that_was_not_fetched_is_refused_with_the_command_that_fetches_it(clone):
    with pytest.raises(UsageError, match="'jazzy', which is not in this clone") as refused:
        merge_target(repository_of(str(clone)), {"GITHUB_BASE_REF": "jazzy"})
    assert "git fetch --depth 50 origin jazzy:refs/remotes/origin/jazzy" in refused.value.advice


def test_a_remote_without_a_known_default(clone):
    git(clone, "remote", "set-head", "origin", "--delete")
    with pytest.raises(UsageError, match="default branch of remote 'origin'") as refused:
        merge_target(repository_of(str(clone)), {})
    assert "git remote set-head origin --auto" in refused.value.advice


def test_no_remote(clone):
    git(clone, "remote", "remove", "origin")
    with pytest.raises(UsageError, match="the repository has no remote"):
        merge_target(repository_of(str(clone)), {})
