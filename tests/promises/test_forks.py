"""What SECURITY advises for CI on forks does what is said of it."""

import json
import os
import shutil
import sqlite3

import pytest

from roslens.cli.main import main
from roslens.cli.workplace.own_results import why_foreign

MANIFEST = """<package format="3"><name>arm</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>"""
PLUGIN = """
import os
from pathlib import Path
from roslens.plugins.points import Manifest
Path({told!r}).write_text(os.environ.get("TOKEN", ""))
manifest = Manifest(name="theirs", interface="1.0", version="1", text="t", scopes=("package",))
def analyse_package(package, report): pass
"""


@pytest.fixture
def fork(tmp_path, monkeypatch):
    """A branch with a plug-in of its own, and a store of this user from which the findings are gone."""
    root = tmp_path / "fork"
    (root / "arm").mkdir(parents=True)
    (root / "arm" / "package.xml").write_text(MANIFEST)
    (root / "arm" / "long.cpp").write_text("int f() { " + "if (g()) h(); " * 40 + "}\n")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "user"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("TOKEN", "of the project")
    assert check(root) == 1
    return root


def check(root, *words):
    return main(["check", str(root), "-q", "--jobs", "1", "--fail-on", "note", *words])


def test_nothing_of_the_branch_runs_and_no_store_is_read(fork, tmp_path, capsys):
    store = sqlite3.connect(fork / ".roslens" / "store.sqlite")
    store.execute("DELETE FROM finding")
    store.commit()
    store.close()
    (fork / "theirs.py").write_text(PLUGIN.format(told=str(tmp_path / "told")))
    (fork / "roslens.toml").write_text("plugins = ['theirs.py']\n")
    capsys.readouterr()
    check(fork, "--no-store", "--no-cache", "--format", "json")
    report = json.loads(capsys.readouterr().out)
    assert report["findings"]
    assert any("not trusted" in one["what"] or "trust" in one["advice"] for one in report["failures"])
    assert not (tmp_path / "told").exists()


def test_results_are_taken_on_another_machine_that_has_the_secret(fork, tmp_path):
    shutil.copytree(tmp_path / "user", tmp_path / "other" / "config")
    assert why_foreign(fork / ".roslens", {**os.environ, "XDG_CONFIG_HOME": str(tmp_path / "other" / "config")}) == ""
    assert why_foreign(fork / ".roslens", {**os.environ, "XDG_CONFIG_HOME": str(tmp_path / "empty")})
