"""How often files changed within a year before the newest commit."""

import os
import subprocess

import pytest

from roslens.source.history.recent_changes import recent_changes

DAY_S = 24 * 3600
NOW_S = 1_700_000_000
PERSON = {f"GIT_{role}_{what}": "a@b.example" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}


@pytest.fixture
def git(tmp_path):
    def run(*words, days_ago=0):
        when = {f"GIT_{role}_DATE": f"{NOW_S - days_ago * DAY_S} +0000" for role in ("AUTHOR", "COMMITTER")}
        command = ["git", "-C", str(tmp_path), *words]
        subprocess.run(command, check=True, capture_output=True, env={**os.environ, **PERSON, **when})

    run("init", "-q")
    return run


def committed(git, folder, paths, days_ago):
    for path in paths:
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(f"{days_ago}")
    git("add", "-A")
    git("commit", "-qm", "x", days_ago=days_ago)


def test_commits_of_the_year_before_the_newest_count(git, tmp_path):
    committed(git, tmp_path, ["a.cpp", "old.cpp"], 500)
    committed(git, tmp_path, ["a.cpp", "p/b é.cpp"], 30)
    committed(git, tmp_path, ["a.cpp"], 0)
    assert recent_changes(str(tmp_path)) == {"a.cpp": 2, "p/b é.cpp": 1}


def test_paths_are_of_the_folder_that_was_asked_for(git, tmp_path):
    committed(git, tmp_path, ["a.cpp", "p/b.cpp"], 0)
    assert recent_changes(str(tmp_path / "p")) == {"b.cpp": 1}


def test_without_a_commit_or_a_repository_nothing_is_known(git, tmp_path):
    assert recent_changes(str(tmp_path)) == {}
    assert recent_changes(str(tmp_path / "none")) == {}


def test_in_a_shallow_clone_nothing_is_known(git, tmp_path):
    for days_ago in (2, 1, 0):
        committed(git, tmp_path, ["a.cpp", f"b{days_ago}.cpp"], days_ago)
    git("clone", "-q", "--depth", "2", f"file://{tmp_path}/.git", str(tmp_path / "shallow"))
    assert recent_changes(str(tmp_path / "shallow")) == {}
