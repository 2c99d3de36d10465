"""A module in the current folder is imported by no child, whatever way it is started in."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from roslens.children.safe_path import (
    NEUTRAL,
    absolute,
    absolute_search_paths,
    elsewhere,
    python_words,
    safe_environment,
    without_current_folder,
)

SHADOWED = ("struct", "random", "socket", "signal", "selectors", "threading", "json", "rclpy", "msgspec")


@pytest.fixture
def hostile(tmp_path, monkeypatch):
    """The current folder, with a file beside which each module of the standard library would be found."""
    for name in SHADOWED:
        (tmp_path / f"{name}.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'a').write('{name} ')\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("path", [None, ["", ".", *sys.path]])
def test_what_code_imports_is_the_standard_library(hostile, path):
    words = python_words(sys.executable, "import struct, random, json; print(sys.argv[1:])", ["a", "b"], path)
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout == "['a', 'b']\n"
    assert not (hostile / "ran").exists()


def test_an_empty_entry_of_the_users_path_means_a_neutral_folder(hostile):
    words = python_words(sys.executable, "import struct, json")
    done = subprocess.run(words, env={**os.environ, "PYTHONPATH": ":/nowhere"}, cwd=NEUTRAL, check=True)
    assert not done.returncode
    assert not (hostile / "ran").exists()


def test_entries_that_depend_on_the_current_folder_are_left_out():
    assert absolute(["", ".", "src", "/a", "/b"]) == ["/a", "/b"]
    assert safe_environment({"A": "1"}) == {"A": "1", "PYTHONSAFEPATH": "1"}


def test_search_paths_of_the_environment_lose_what_depends_on_the_current_folder():
    before = {"PATH": "/bin::/usr/bin", "PYTHONPATH": ":/a", "LD_LIBRARY_PATH": "/b:", "CPATH": ":/c", "HOME": ""}
    after = {"PATH": "/bin:/usr/bin", "PYTHONPATH": "/a", "LD_LIBRARY_PATH": "/b", "CPATH": ":/c", "HOME": ""}
    assert without_current_folder(before) == after
    assert without_current_folder(after) == after
    assert without_current_folder({"PATH": ".:bin"}) == {"PATH": "/"}, "an empty one would mean the current folder"
    assert absolute_search_paths({"PATH": "/bin", "PYTHONPATH": ""}) == {}


def test_doctor_names_search_paths_with_such_an_entry(hostile):
    program = Path(sys.executable).with_name("roslens")
    environment = {**os.environ, "PYTHONPATH": ":/nowhere", "LD_LIBRARY_PATH": "/nowhere"}
    done = subprocess.run(
        [str(program), "doctor"], env=environment, capture_output=True, text=True, timeout=300, check=False
    )
    assert "note  $PYTHONPATH has an empty or relative entry" in done.stdout
    assert "$LD_LIBRARY_PATH" not in done.stdout


def test_python_itself_takes_what_it_begins_with_from_the_current_folder(hostile):
    (hostile / "sitecustomize.py").write_text("raise SystemExit('taken')\n")
    environment = {**os.environ, "PYTHONPATH": ":/nowhere"}
    done = subprocess.run([sys.executable, "-c", ""], env=environment, capture_output=True, text=True, check=False)
    assert "taken" in done.stderr


@pytest.mark.parametrize("words", [("roslens",), (sys.executable, "-m", "roslens")], ids=["roslens", "-m"])
@pytest.mark.parametrize("path", ["", ":/nowhere", "."])
def test_the_command_imports_nothing_of_the_folder_it_is_started_in(hostile, words, path):
    program = Path(sys.executable).with_name(words[0]) if words[0] == "roslens" else words[0]
    environment = {**os.environ, "PYTHONPATH": path}
    asked = [str(program), *words[1:], "check", ".", "--no-store", "--no-cache"]
    done = subprocess.run(asked, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert "0 of 0 packages measured" in done.stderr
    assert not (hostile / "ran").exists()


def test_elsewhere_comes_back(hostile, monkeypatch):
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    with elsewhere():
        assert Path.cwd() == Path(NEUTRAL)
        assert os.environ["PYTHONSAFEPATH"] == "1"
    assert Path.cwd() == hostile
    assert "PYTHONSAFEPATH" not in os.environ


@pytest.mark.parametrize("method", ["fork", "forkserver"])
def test_a_pool_imports_nothing_of_the_folder_it_is_started_in(hostile, method):
    code = (
        "from roslens.children.worker_pool import worker_pool\n"
        "import operator\n"
        "if __name__ == '__main__':\n"
        f"    with worker_pool(2, {method!r}) as pool:\n"
        "        print(sorted(pool.map(operator.neg, range(3))))"
    )
    script = hostile.parent / f"{hostile.name}-script.py"
    script.write_text(code)
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=60, check=False)
    assert done.stdout == "[-2, -1, 0]\n", done.stderr
    assert not (hostile / "ran").exists()
