"""What a clone brings as results of an earlier run is refused; what this user made is taken."""

import os
import shutil
import sqlite3
import subprocess

import pytest

from roslens.cli.main import main
from roslens.cli.terminal.boundary import BAD_INPUT
from roslens.cli.workplace.own_results import MARK, refuse_foreign
from roslens.cli.workplace.user_folder import user_folder, user_secret
from roslens.model.errors import UsageError

MANIFEST = '<package format="3"><name>a</name><version>1.0.0</version><description>d</description>\
<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>'


@pytest.fixture
def checked(tmp_path, monkeypatch):
    """A repository that somebody else checked, with their store in it."""
    root = tmp_path / "clone"
    (root / "a").mkdir(parents=True)
    (root / "a" / "package.xml").write_text(MANIFEST)
    (root / "a" / "a.cpp").write_text("int f() { " + "if (g()) h(); " * 40 + "}\n")
    subprocess.run(["git", "init", "-q", str(root)], check=True)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "other"))
    main(["check", str(root), "-q", "--jobs", "1", "--fail-on", "never"])
    return root


def as_another_user(root, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(root.parent / "user"))


def test_a_forged_verdict_is_refused_by_every_verb(checked, monkeypatch, capsys):
    store = sqlite3.connect(checked / ".roslens" / "store.sqlite")
    store.execute("DELETE FROM finding")
    store.commit()
    as_another_user(checked, monkeypatch)
    for words in (["check"], ["check", "--no-cache"], ["report"], ["serve"], ["graph"], ["clean"]):
        assert main([*words, str(checked)]) == BAD_INPUT
        assert "was made by another user" in capsys.readouterr().err
    assert main(["check", str(checked), "-q", "--no-store", "--no-cache", "--jobs", "1"]) in (0, 1)
    assert main(["clean", "--all", str(checked)]) == 0
    assert main(["check", str(checked), "-q", "--jobs", "1"]) in (0, 1)


def test_the_users_own_is_taken_after_the_workspace_moved(checked):
    moved = checked.parent / "moved"
    shutil.move(checked, moved)
    assert main(["check", str(moved), "-q", "--jobs", "1"]) in (0, 1)


def test_what_git_tracks_came_with_the_source(checked, capsys):
    subprocess.run(["git", "add", "-f", ".roslens"], cwd=checked, check=True)
    assert main(["check", str(checked)]) == BAD_INPUT
    said = capsys.readouterr().err
    assert "is part of a git repository, so it came with the source" in said
    assert "roslens clean --all" in said


def test_a_store_without_a_mark_is_refused(checked, capsys):
    (checked / ".roslens" / MARK).unlink()
    assert main(["check", str(checked)]) == BAD_INPUT
    assert "has no mark of its creator" in capsys.readouterr().err


def test_past_revisions_that_a_clone_brings_are_refused(tmp_path):
    (tmp_path / ".roslens").mkdir()
    (tmp_path / ".roslens/history.sqlite").write_bytes(b"")
    with pytest.raises(UsageError, match="has no mark of its creator"):
        refuse_foreign(tmp_path / ".roslens", os.environ)


@pytest.mark.parametrize("name", ["store.sqlite", "cache.sqlite", "history.sqlite"])
@pytest.mark.parametrize("kind", ["link", "pipe"])
def test_files_that_are_no_plain_files(checked, name, kind, capsys):
    place = checked / ".roslens" / name
    place.unlink(missing_ok=True)
    place.symlink_to("/proc/kmsg") if kind == "link" else os.mkfifo(place)
    assert main(["check", str(checked)]) == BAD_INPUT
    assert f"has a {name} that is not a regular file" in capsys.readouterr().err


def test_a_link_is_refused_and_cleaning_removes_only_the_link(checked, capsys):
    folder = checked / ".roslens"
    folder.rename(checked.parent / "target")
    folder.symlink_to(checked.parent / "target")
    assert main(["check", str(checked)]) == BAD_INPUT
    assert "is a link" in capsys.readouterr().err
    assert main(["clean", "--all", str(checked)]) == 0
    assert (checked.parent / "target" / "store.sqlite").is_file()
    assert not folder.is_symlink()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a folder to somebody else")
def test_a_folder_of_somebody_else(checked):
    os.chown(checked / ".roslens", 12345, -1)
    with pytest.raises(UsageError, match="belongs to another user"):
        refuse_foreign(checked / ".roslens", os.environ)


def test_the_secret_is_private_and_stays(tmp_path):
    environment = {"XDG_CONFIG_HOME": str(tmp_path)}
    secret = user_secret(environment)
    assert len(secret) == 32
    assert user_secret(environment) == secret
    assert (user_folder(environment) / "secret").stat().st_mode & 0o777 == 0o600
    assert user_secret({"XDG_CONFIG_HOME": str(tmp_path / "other")}) != secret


def test_without_a_folder_for_it_the_secret_is_that_of_the_machine(tmp_path):
    (tmp_path / "roslens").write_text("no folder")
    environment = {"XDG_CONFIG_HOME": str(tmp_path)}
    assert user_secret(environment) == user_secret(environment)
