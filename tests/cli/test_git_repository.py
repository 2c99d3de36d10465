"""Which folder and which variables git is asked with; what it answers is in the tests of trees and submodules."""

import os

import pytest

from roslens.cli.git_repository import Repository, repository_of
from roslens.model.errors import UsageError


def test_objects_of_submodules_are_given_to_git_whatever_their_folder_is_called():
    found = Repository("/r", objects=("/a b", '/c"d:e')).environment()["GIT_ALTERNATE_OBJECT_DIRECTORIES"]
    assert found == '"/a b"' + os.pathsep + '"/c\\"d:e"'
    assert Repository("/inner", within="/r").command("status")[-3:] == ["-C", "/r", "status"]


def test_nothing_is_fetched_and_nobody_is_asked():
    environment = Repository("/r").environment()
    assert environment["GIT_NO_LAZY_FETCH"] == "1"
    assert environment["GIT_TERMINAL_PROMPT"] == "0"
    assert "protocol.allow=never" in Repository("/r").command()


def test_outside_of_any(tmp_path, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    with pytest.raises(UsageError, match="no git repository"):
        repository_of(str(tmp_path))
