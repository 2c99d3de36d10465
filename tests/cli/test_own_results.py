"""What a clone brings as results of an earlier run is set aside; what this user made is taken."""

import hmac
import os
import shutil
import sqlite3
import subprocess

import pytest

from roslens.cli.main import main
from roslens.cli.terminal.boundary import BAD_INPUT, FINDINGS
from roslens.cli.workplace import workplace
from roslens.cli.workplace.own_results import MARK, why_foreign
from roslens.intake.user_folder import user_folder, user_secret

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
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr(workplace, "_TOLD", set())
    main(["check", str(root), "-q", "--jobs", "1", "--fail-on", "never"])
    return root


def as_another_user(root, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(root.parent / "user"))


def forge(folder):
    execute(folder, "DELETE FROM finding")


def execute(folder, statement):
    store = sqlite3.connect(folder / "store.sqlite")
    store.execute(statement)
    store.commit()
    store.close()


def gate(root, *more):
    return main(["check", str(root), "-q", "--jobs", "1", "--fail-on", "note", *more])


def test_a_forged_verdict_is_set_aside_with_one_line_and_stays_as_it_is(checked, monkeypatch, capsys):
    forge(checked / ".roslens")
    before = {one.name: one.read_bytes() for one in (checked / ".roslens").iterdir()}
    as_another_user(checked, monkeypatch)
    assert gate(checked) == FINDINGS
    said = capsys.readouterr().err
    assert said.count("was made by another user, or somewhere else: it is set aside") == 1
    assert {one.name: one.read_bytes() for one in (checked / ".roslens").iterdir()} == before
    # Every other command shows the user's own run.
    for words in (["report", "-o", str(checked.parent / "out"), "-q"], ["check", "-q", "--fail-on", "note"], ["clean"]):
        assert main([words[0], str(checked), *words[1:]]) in (0, FINDINGS)
    assert main(["clean", "--all", str(checked)]) == 0
    assert not (checked / ".roslens").exists()
    assert list((checked.parent / "state/roslens/workspaces").iterdir()) == []


def test_containers_with_a_new_home_each_go_on(checked, monkeypatch):
    for number in range(3):
        monkeypatch.setenv("XDG_CONFIG_HOME", str(checked.parent / f"home{number}"))
        monkeypatch.setenv("XDG_STATE_HOME", str(checked.parent / f"state{number}"))
        assert gate(checked) == FINDINGS
    assert sorted(one.name for one in checked.iterdir()) == [".git", ".roslens", "a"]


def test_a_report_without_a_run_of_this_user_has_none(checked, monkeypatch, capsys):
    as_another_user(checked, monkeypatch)
    assert main(["evidence", "a", "--workspace", str(checked)]) == BAD_INPUT
    assert "no finished run in" in capsys.readouterr().err


def test_a_leaked_mark_opens_no_other_folder(checked, tmp_path):
    other = tmp_path / "other-clone"
    shutil.copytree(checked, other)
    forge(other / ".roslens")
    assert why_foreign(checked / ".roslens", os.environ) == ""
    assert why_foreign(other / ".roslens", os.environ).startswith("was made by another user, or somewhere else")
    assert gate(other) == FINDINGS


def earlier_mark():
    return hmac.new(user_secret(os.environ), b"results of roslens", "sha256").hexdigest().encode()


def test_the_mark_of_an_earlier_version_is_taken_and_renewed(checked):
    (checked / ".roslens" / MARK).write_bytes(earlier_mark())
    (user_folder(os.environ) / "marks-of-folders").unlink()
    assert why_foreign(checked / ".roslens", os.environ) == ""
    run = (checked / ".roslens" / "store.sqlite").stat().st_ino
    assert gate(checked) == FINDINGS
    assert (checked / ".roslens" / "store.sqlite").stat().st_ino == run
    assert earlier_mark() not in (checked / ".roslens" / MARK).read_bytes()


def test_a_mark_of_an_earlier_version_that_came_later_is_not_taken(checked):
    (checked / ".roslens" / MARK).write_bytes(earlier_mark())
    os.utime(checked / ".roslens" / MARK, (0, 0))
    os.utime(user_folder(os.environ) / "marks-of-folders", (1, 1))
    assert why_foreign(checked / ".roslens", os.environ)


def test_the_users_own_is_taken_after_the_workspace_moved(checked):
    moved = checked.parent / "moved"
    shutil.move(checked, moved)
    assert why_foreign(moved / ".roslens", os.environ) == ""
    assert gate(moved) == FINDINGS
    again = checked.parent / "again"
    moved.rename(again)
    assert why_foreign(again / ".roslens", os.environ) == ""


def test_what_git_tracks_came_with_the_source(checked, capsys):
    subprocess.run(["git", "add", "-f", ".roslens"], cwd=checked, check=True)
    assert gate(checked) == FINDINGS
    said = capsys.readouterr().err
    assert "is part of a git repository, so it came with the source: it is set aside" in said
    assert "roslens clean --all" in said


def test_a_store_without_a_mark_is_set_aside(checked, capsys):
    (checked / ".roslens" / MARK).unlink()
    assert gate(checked) == FINDINGS
    assert "has no mark of its creator" in capsys.readouterr().err


def test_past_revisions_that_a_clone_brings_are_foreign(tmp_path):
    (tmp_path / ".roslens").mkdir()
    (tmp_path / ".roslens/history.sqlite").write_bytes(b"")
    assert why_foreign(tmp_path / ".roslens", os.environ) == "has no mark of its creator"


@pytest.mark.parametrize("name", ["store.sqlite", "cache.sqlite", "history.sqlite"])
@pytest.mark.parametrize("kind", ["link", "pipe"])
def test_files_that_are_no_plain_files(checked, name, kind, capsys):
    place = checked / ".roslens" / name
    place.unlink(missing_ok=True)
    place.symlink_to("/proc/kmsg") if kind == "link" else os.mkfifo(place)
    assert gate(checked) == FINDINGS
    assert f"has a {name} that is not a regular file" in capsys.readouterr().err


def test_a_link_is_set_aside_and_cleaning_removes_only_the_link(checked, capsys):
    folder = checked / ".roslens"
    folder.rename(checked.parent / "target")
    folder.symlink_to(checked.parent / "target")
    assert gate(checked) == FINDINGS
    assert "is a link" in capsys.readouterr().err
    assert main(["clean", "--all", str(checked)]) == 0
    assert (checked.parent / "target" / "store.sqlite").is_file()
    assert not folder.is_symlink()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a folder to somebody else")
def test_a_folder_of_somebody_else(checked):
    os.chown(checked / ".roslens", 12345, -1)
    assert why_foreign(checked / ".roslens", os.environ) == "belongs to another user (number 12345)"


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


def test_a_store_that_was_changed_is_set_aside_with_one_line(checked, capsys):
    """Even with the mark of its user beside it: the store is signed as a whole."""
    forge(checked / ".roslens")
    assert why_foreign(checked / ".roslens", os.environ) == ""
    assert gate(checked) == FINDINGS
    said = capsys.readouterr().err
    assert said.count("was changed by something other than roslens of this user: it is set aside as") == 1
    assert gate(checked) == FINDINGS
    assert "changed by something" not in capsys.readouterr().err
    assert main(["report", str(checked), "-o", str(checked.parent / "out"), "-q"]) == 0
    # Nor is it lost.
    assert (checked / ".roslens" / "store.set-aside-1.sqlite").is_file()


def test_a_report_of_a_store_that_was_changed_has_no_run(checked, capsys):
    forge(checked / ".roslens")
    assert main(["report", str(checked), "-o", str(checked.parent / "out"), "-q"]) == BAD_INPUT
    said = capsys.readouterr().err
    assert "was changed by something" in said
    assert "no run was completed yet" in said


def test_a_store_of_another_folder_of_the_user_opens_nothing_here(checked, tmp_path, capsys):
    other = tmp_path / "other-clone"
    shutil.copytree(checked, other, ignore=shutil.ignore_patterns(".roslens"))
    assert gate(other) == FINDINGS
    for name in ("store.sqlite", "store.sqlite.seal"):
        shutil.copy2(checked / ".roslens" / name, other / ".roslens" / name)
    capsys.readouterr()
    assert gate(other) == FINDINGS
    assert "was changed by something" in capsys.readouterr().err
    # Nor with the mark that belongs to it.
    shutil.copy2(checked / ".roslens" / MARK, other / ".roslens" / MARK)
    assert why_foreign(other / ".roslens", os.environ)


def test_a_store_that_an_earlier_version_left_is_signed_with_one_line(checked, capsys):
    execute(checked / ".roslens", "DROP TABLE seal")
    (checked / ".roslens" / "store.sqlite.seal").unlink()
    (user_folder(os.environ) / "sealed-stores").unlink()
    assert gate(checked) == FINDINGS
    assert capsys.readouterr().err.count("are of an earlier version, which did not sign them") == 1
    assert gate(checked) == FINDINGS
    assert "earlier version" not in capsys.readouterr().err
    # One that comes afterwards is not.
    execute(checked / ".roslens", "DROP TABLE seal")
    assert gate(checked) == FINDINGS
    assert "was changed by something" in capsys.readouterr().err


def test_a_mark_without_identity_is_taken_and_renewed(checked, capsys):
    mark = checked / ".roslens" / MARK
    secret = user_secret(os.environ)
    found = mark.parent.stat()
    places = (os.fsencode(mark.parent.resolve()), b"%d:%d" % (found.st_dev, found.st_ino))
    mark.write_text(
        "\n".join(hmac.new(secret, b"results of roslens in\0" + one, "sha256").hexdigest() for one in places)
    )
    assert why_foreign(mark.parent, os.environ) == ""
    assert gate(checked) == FINDINGS
    assert len(mark.read_text().split()) == 3
    assert capsys.readouterr().err == ""
