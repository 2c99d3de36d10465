"""A temporary folder goes with its owner, at the latest when the next process looks; never before."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from roslens.children.scratch_folder import ScratchFolder, sweep_scratch
from roslens.cli.main import main

OWNER = """
import os, sys
from roslens.children.scratch_folder import ScratchFolder
with ScratchFolder("ruff") as folder:
    os.makedirs(folder + "/deep/er")
    open(folder + "/deep/er/file", "w").close()
    {more}
    print(folder, flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", None)
    return tmp_path


def owner(more="pass"):
    process = subprocess.Popen(
        [sys.executable, "-c", OWNER.format(more=more)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    return process, Path(process.stdout.readline().strip())


def ended(process):
    process.stdin.close()
    process.stdout.close()
    process.wait()


def test_it_is_removed_at_the_end(temporary):
    with ScratchFolder("past") as folder:
        assert Path(folder).parent == temporary
        assert Path(folder).name.startswith("roslens.past.")
        assert Path(folder).stat().st_mode & 0o777 == 0o700
        sweep_scratch()
        assert Path(folder).is_dir()
    assert list(temporary.iterdir()) == []


def test_what_a_killed_process_left_is_swept(temporary):
    process, folder = owner()
    sweep_scratch()
    assert folder.is_dir()
    process.kill()
    process.wait()
    assert folder.is_dir()
    sweep_scratch()
    assert not folder.exists()
    ended(process)


def test_a_child_that_lives_on_keeps_it(temporary):
    process, folder = owner("child = os.fork()\n    if not child: sys.stdin.read(); os._exit(0)")
    process.kill()
    process.wait()
    sweep_scratch()
    assert folder.is_dir()
    ended(process)


def test_only_own_folders_with_the_name_of_this_scheme(temporary):
    elsewhere = temporary / "elsewhere"
    elsewhere.mkdir()
    kept = [temporary / name for name in ("roslens-ruff-ab12", "roslens-bug-1.txt", "roslen.x", "pymp-abc")]
    for one in kept:
        one.mkdir()
    (temporary / "roslens.link.a").symlink_to(elsewhere)
    (temporary / "roslens.file.a").write_text("")
    (temporary / "roslens.left.a").mkdir()
    sweep_scratch()
    assert sorted(one.name for one in temporary.iterdir()) == sorted(
        [*(one.name for one in kept), "elsewhere", "roslens.link.a", "roslens.file.a"]
    )


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a folder to somebody else")
def test_a_folder_of_another_user_stays(temporary):
    (temporary / "roslens.left.a").mkdir()
    os.chown(temporary / "roslens.left.a", 12345, -1)
    sweep_scratch()
    assert (temporary / "roslens.left.a").is_dir()


def test_one_that_was_swept_before_it_was_locked_is_made_anew(temporary, monkeypatch):
    made = tempfile.TemporaryDirectory

    def swept_once(**given):
        monkeypatch.setattr(tempfile, "TemporaryDirectory", made)
        folder = made(**given)
        sweep_scratch()
        return folder

    monkeypatch.setattr(tempfile, "TemporaryDirectory", swept_once)
    with ScratchFolder("x") as folder:
        assert Path(folder).is_dir()
    assert list(temporary.iterdir()) == []


def test_every_command_sweeps(temporary, capsys):
    (temporary / "roslens.left.a").mkdir()
    main(["explain", "RL-no-such-rule"])
    assert not (temporary / "roslens.left.a").exists()


POOL = """
import sys
from roslens.children.worker_pool import worker_pool
with worker_pool(1, "forkserver") as pool:
    print(pool.submit(abs, -1).result(), flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def short(monkeypatch):
    """A temporary folder with a path in which there is room for the names of sockets."""
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        monkeypatch.setenv("TMPDIR", folder)
        monkeypatch.setattr(tempfile, "tempdir", None)
        yield Path(folder)


def test_pools_start_where_the_path_leaves_no_room_for_names_of_sockets(short, monkeypatch):
    place = short / ("x" * (107 - len(f"{short}//pymp-abcdefgh/listener-abcdefgh")))
    place.mkdir()
    monkeypatch.setenv("TMPDIR", str(place))
    process = subprocess.run([sys.executable, "-c", POOL], input="", capture_output=True, text=True, check=False)
    assert (process.stdout, process.stderr) == ("1\n", "")
    assert list(place.iterdir()) == []


def test_pools_start_again_after_their_folder_was_removed(short):
    twice = (
        POOL
        + """
import os
for name in os.listdir(os.environ["TMPDIR"]):
    os.rename(os.environ["TMPDIR"] + "/" + name, os.environ["TMPDIR"] + "/gone")
with worker_pool(1, "forkserver") as pool:
    print(pool.submit(abs, -2).result(), flush=True)
"""
    )
    process = subprocess.run([sys.executable, "-c", twice], input="", capture_output=True, text=True, check=False)
    assert process.stdout == "1\n2\n", process.stderr


def test_sockets_of_worker_pools_are_in_one(short):
    temporary = short
    process = subprocess.Popen([sys.executable, "-c", POOL], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "1\n"
    assert [one.name.rpartition(".")[0] for one in temporary.iterdir()] == ["roslens.mp"]
    sweep_scratch()
    assert len(list(temporary.iterdir())) == 1
    process.kill()
    ended(process)
    sweep_scratch()
    assert list(temporary.iterdir()) == []
    process = subprocess.Popen([sys.executable, "-c", POOL], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert process.communicate()[0] == "1\n"
    assert list(temporary.iterdir()) == []
