"""Which folder and which variables git is asked with; what it answers is in the tests of trees and submodules."""

import os

import pytest

from roslens.cli.git.git_repository import Repository, repository_of
from roslens.model.errors import UsageError


def test_objects_of_submodules_are_given_to_git_whatever_their_folder_is_called():
    found = Repository("/r", objects=("/a b", '/c"d:e')).environment()["GIT_ALTERNATE_OBJECT_DIRECTORIES"]
    assert found == '"/a b"' + os.pathsep + '"/c\\"d:e"'
    assert Repository("/inner", within="/r").command("ls-tree")[-3:] == ["-C", "/r", "ls-tree"]


def test_nothing_is_fetched_and_nobody_is_asked():
    environment = Repository("/r").environment()
    assert environment["GIT_NO_LAZY_FETCH"] == "1"
    assert environment["GIT_TERMINAL_PROMPT"] == "0"
    assert "protocol.allow=never" in Repository("/r").command("ls-tree")


def test_outside_of_any(tmp_path, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(UsageError, match="no git repository"):
        repository_of(str(tmp_path))


def test_a_bare_repository_that_a_clone_brings_is_not_asked(tmp_path):
    for name in ("objects", "refs"):
        (tmp_path / name).mkdir()
    (tmp_path / "HEAD").write_text("ref: refs/heads/main\n")
    with pytest.raises(UsageError, match="looks like a bare git repository"):
        repository_of(str(tmp_path))
