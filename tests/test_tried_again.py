"""Tests that are tried again where the machine gave them no time; each run is a pytest of its own."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

HEAD = """
import os, time
import pytest
import tried_again

class Watched:
    def __init__(self, sleeper):
        pass
    def begin(self, begun):
        pass
    def starved(self):
        return os.environ["SEEN"]

tried_again.Watched = Watched

def pytest_configure(config):
    config.addinivalue_line("markers", "real: of this test")
    config.pluginmanager.register(tried_again.TriedAgain())

def note(what):
    with open(os.environ["NOTES"], "a") as file:
        file.write(what + " ")

def tries():
    note("try")
    with open(os.environ["NOTES"]) as file:
        return file.read().split().count("try")

def shared(name, scope):
    def make(request):
        note("+" + name)
        yield name
        note("-" + name)
    return pytest.fixture(make, scope=scope, name=name)

session, module, function = (shared(name, name) for name in ("session", "module", "function"))
"""


pytestmark = [pytest.mark.heavy, pytest.mark.timed]


@pytest.fixture
def run(tmp_path):
    """Run tests; returns how it ended, what it printed, and what they noted."""

    def run(text, *words, seen="it stood still", more=()):
        (tmp_path / "conftest.py").write_text(HEAD)
        (tmp_path / "test_it.py").write_text(f"import time\nimport pytest\nfrom conftest import note, tries\n{text}")
        (tmp_path / "pytest.ini").write_text("[pytest]\ntimeout = 60\nfilterwarnings = error\n")
        notes = tmp_path / "notes"
        notes.write_text("")
        command = [
            sys.executable,
            "-m",
            "pytest",
            "-p",
            "no:cacheprovider",
            "-p",
            "xdist.plugin",
            "-p",
            "pytest_timeout",
            *words,
        ]
        environment = {
            "PATH": "/usr/bin:/bin",
            "PYTHONPATH": str(Path(__file__).parent),
            "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1",
            "SEEN": seen,
            **dict(more),
        }
        done = subprocess.run(
            command, cwd=tmp_path, env={**environment, "NOTES": str(notes)}, capture_output=True, text=True,
            timeout=240, check=False,
        )  # fmt: skip
        return done.returncode, done.stdout + done.stderr, notes.read_text().split()

    return run


SECOND = """
@pytest.mark.real
def test_a(session, module, function, tmp_path):
    assert not list(tmp_path.iterdir())
    (tmp_path / "left").touch()
    assert tries() == 2, "too early"

def test_b(module):
    note("b")
"""


@pytest.mark.parametrize("words", [(), ("-n", "2", "--dist", "loadfile")])
def test_a_try_begins_where_the_session_began_and_the_first_failure_is_told(run, words):
    code, said, notes = run(SECOND, *words)
    assert code == 0, said
    assert "2 passed, 1 rerun" in said
    assert "AssertionError: too early" in said
    assert "tried again: test_it.py::test_a: it stood still" in said
    fresh = ["+session", "+module", "+function", "try", "-function"]
    assert notes == [*fresh, "-module", "-session", *fresh, "b", "-module", "-session"]


MANY = """
@pytest.mark.real
@pytest.mark.parametrize("number", range({}))
def test_a(number):
    note(f"n{{number}}")
    from pathlib import Path
    import os
    assert Path(os.environ["NOTES"]).read_text().split().count(f"n{{number}}") == 2
"""


@pytest.mark.parametrize(("many", "ci", "code"), [(3, True, 0), (4, True, 1), (4, False, 0)])
def test_more_than_three_reruns_fail_ci(run, many, ci, code):
    ended, said, _ = run(MANY.format(many), *(("-n", "2") if ci else ()), more={"CI": "true"} if ci else {})
    assert f"{many} passed, {many} rerun" in said
    assert ended == code, said
    assert ("at most 3 may be" in said) is bool(code)


def test_where_it_had_its_time_the_first_failure_counts(run):
    code, said, notes = run(SECOND, seen="")
    assert code == 1
    assert "1 failed, 1 passed" in said
    assert "tried again" not in said
    assert notes.count("try") == 1


def test_after_three_tries_it_has_failed(run):
    code, said, notes = run(SECOND.replace("tries() == 2", "tries() == 9"))
    assert code == 1
    assert "1 failed, 1 passed, 2 rerun" in said
    assert notes.count("try") == 3
    assert [notes.count(sign + name) for sign in "+-" for name in ("session", "module", "function")] == [3] * 6


def test_what_is_not_about_time_is_not_tried_again(run):
    code, said, notes = run(SECOND.replace("@pytest.mark.real", ""))
    assert code == 1
    assert "tried again" not in said
    assert notes.count("try") == 1


def test_each_try_has_a_clock_of_its_own(run):
    text = """
@pytest.mark.real
@pytest.mark.timeout(3)
def test_a():
    number = tries()
    if number == 2:
        time.sleep(1000)
    assert number == 3
"""
    code, said, _ = run(text)
    assert code == 0, said
    assert "1 passed, 2 rerun" in said
    assert "Timeout (>3.0s)" in said


@pytest.mark.parametrize("last", ["", "\ndef test_b(late):\n    note('b')\n"])
def test_what_could_not_be_set_up_is_set_up_anew_and_ends(run, last):
    text = """
@pytest.fixture(scope="module")
def late(session):
    note("+late")
    assert tries() == 2
    yield
    note("-late")

@pytest.mark.real
def test_a(late):
    pass
"""
    code, said, notes = run(text + last)
    assert code == 0, said
    assert "1 rerun" in said
    again = ["+session", "+late", "try"]
    assert notes == [*again, "-session", *again, *(["b"] if last else []), "-late", "-session"]


def test_what_does_not_end_well_is_tried_again_and_said(run):
    text = """
@pytest.fixture(scope="module")
def late():
    yield
    assert tries() != 2, "never ended"

@pytest.mark.real
def test_a(late):
    assert tries() == 3

def test_b(late):
    pass
"""
    code, said, _ = run(text)
    assert code == 0, said
    assert re.search(r"test_a: it stood still; what it left did not end well: .*never ended", said)


def test_a_failure_of_an_end_is_a_failure_of_the_try(run):
    text = """
@pytest.fixture
def late():
    yield
    assert tries() == 2

@pytest.mark.real
def test_a(late):
    pass
"""
    code, said, _ = run(text)
    assert code == 0, said
    assert "1 passed, 1 rerun" in said


def test_a_class_begins_anew(run):
    text = """
@pytest.mark.real
class TestIt:
    def test_a(self):
        assert not hasattr(self, "left")
        self.left = True
        assert tries() == 2
"""
    code, said, _ = run(text)
    assert code == 0, said
    assert "1 passed, 1 rerun" in said


def test_what_it_forgot_troubles_nobody(run):
    text = """
import os, socket, subprocess

@pytest.mark.real
def test_a():
    forgotten, line = subprocess.Popen(["sleep", "1000"]), socket.socket()
    if tries() == 1:
        note(str(forgotten.pid))
        assert False
    forgotten.kill()
    forgotten.wait()
    line.close()

def test_b():
    import gc
    gc.collect()
"""
    code, said, notes = run(text)
    assert code == 0, said
    assert "2 passed, 1 rerun" in said
    assert "it stood still; 1 processes that it left were killed" in said
    state = Path("/proc", notes[1], "stat")
    # Who inherits an orphan takes it off the table in its own time.
    assert not state.exists() or state.read_text().rpartition(")")[2].split()[0] in "ZX"
