"""A repository takes at most four processes of git; an update one more if the server is asked for its branch."""

import json
import shutil

import pytest

from roslens.cli.main import main

MOST = 4


@pytest.fixture
def counted(tmp_path, monkeypatch):
    """Have git write what it is asked for; return what returns that."""
    folder, log = tmp_path / "bin", tmp_path / "asked"
    folder.mkdir()
    git = folder / "git"
    # Git starts itself by another path, so that only what roslens starts is counted.
    git.write_text(f'#!/bin/sh\necho "$@" >> {log}\nexec {shutil.which("git")} "$@"\n')
    git.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}:/usr/bin:/bin")

    def asked():
        lines = log.read_text().splitlines() if log.exists() else []
        log.unlink(missing_ok=True)
        return [line for line in lines if "--git-dir=.git" in line]

    return asked


@pytest.mark.parametrize("version", ["main", ""])
def test_few_processes_for_a_repository(server, here, counted, version):
    names = ["one", "two", "three"]
    entries = {name: {"type": "git", "url": server.package(name, commits=2)} for name in names}
    for entry in entries.values() if version else ():
        entry["version"] = version
    (here / "in.repos").write_text(json.dumps({"repositories": entries}))
    counted()
    assert main(["fetch", "-q", "--into", "ws", "--distribution", "in.repos"]) == 0
    assert 0 < len(counted()) <= MOST * len(names)
    assert main(["fetch", "-q", "--into", "ws", "--update"]) == 0
    assert 0 < len(counted()) <= (MOST + (not version)) * len(names)
    assert main(["fetch", "-q", "--into", "ws"]) == 0
    assert len(counted()) <= len(names)
