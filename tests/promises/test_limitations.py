"""What SECURITY says that it does not guarantee is so: nobody is to rely on more, or to fear more, than is true."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from roslens.intake import file_budget
from roslens.intake.time_budget import OverBudgetError
from roslens.model.source import Location, Package
from roslens.plugins.discovery import discover
from roslens.plugins.isolation import run_package
from roslens.plugins.points import PackageInput
from roslens.report.run.to_diff import to_diff
from roslens.source.rules.package_findings import MOST_SPENT, _hold

TESTS = Path(__file__).parents[1]
GROWN = """
from shapes.readers import measured, ready
from shapes.shapes import SHAPES
ready("C++")
content = SHAPES["C++"]["unclosed templates"](100_000)
found = measured("C++", content)
print(found.left_out or found.grown * 1e6 / len(content))
"""


def test_hostile_cpp_takes_about_2400_times_its_size():
    # In a new process: one that has read much already has memory to spare, which would not be seen to grow.
    ran = subprocess.run([sys.executable, "-c", GROWN], capture_output=True, text=True, cwd=TESTS, check=True)
    assert 1_800 < float(ran.stdout) < 3_000


def test_no_rule_on_a_package_is_tried_once_three_took_too_long():
    asked = []

    def slow(view):
        asked.append(view)
        raise OverBudgetError("it takes more than 10 s of processor time")
        yield

    rules = [SimpleNamespace(id=f"r{number}", found=slow) for number in range(MOST_SPENT + 2)]
    package = SimpleNamespace(id="a", manifest=Location("a/package.xml"))
    failures = []
    _hold(SimpleNamespace(package=package, by_path={}), rules, {}, failures)
    assert len(asked) == MOST_SPENT
    assert len(failures) == MOST_SPENT + 1
    assert "3 others took too long" in failures[-1].what


ESCAPE = """
import subprocess, sys
from roslens.plugins.points import Manifest
manifest = Manifest(name="away", interface="1.0", version="1", text="t", scopes=("package",))

def analyse_package(package, report):
    words = [sys.executable, "-c", "import sys; sys.stdin.read()"]
    started = subprocess.Popen(words, start_new_session=True, stdin=open({pipe!r}))
    open({told!r}, "w").write(str(started.pid))
"""


def test_a_program_in_a_session_of_its_own_outlives_the_plug_in(tmp_path):
    pipe, told = tmp_path / "pipe", tmp_path / "pid"
    os.mkfifo(pipe)
    (tmp_path / "away.py").write_text(ESCAPE.format(pipe=str(pipe), told=str(told)))
    found = discover(["away.py"], base=tmp_path, search=())
    held = os.open(pipe, os.O_RDWR)
    try:
        package = PackageInput(Package("a", "a", "a", Location("a/package.xml")), str(tmp_path / "a"), ())
        assert not run_package(found.members, package, root=str(tmp_path)).failures
        os.kill(int(told.read_text()), signal.SIGKILL)
    finally:
        os.close(held)


def test_memory_is_limited_on_linux(monkeypatch):
    resource = pytest.importorskip("resource")
    asked = []
    monkeypatch.setattr(resource, "setrlimit", lambda *words: asked.append(words))
    monkeypatch.setattr(sys, "platform", "other")
    file_budget._limit_memory()
    assert asked == []
    monkeypatch.undo()
    monkeypatch.setattr(resource, "setrlimit", lambda *words: asked.append(words))
    if sys.platform == "linux":
        file_budget._limit_memory()
        assert [one[0] for one in asked] == [resource.RLIMIT_AS]


def test_a_patch_keeps_control_characters():
    assert b"+\x1b[31m\n" in b"".join(to_diff("a.py", b"a\n", b"\x1b[31m\n"))


def test_workers_need_a_short_temporary_folder(tmp_path):
    """A socket of a longer path cannot be bound: that is a limit of the system's interface (108 bytes)."""
    code = (
        "from multiprocessing.connection import Listener, arbitrary_address; "
        "Listener(arbitrary_address('AF_UNIX'), family='AF_UNIX')"
    )
    for length, works in ((60, True), (110, False)):
        folder = Path("/tmp", f"{os.getpid()}_{time.monotonic_ns()}".ljust(length - 5, "x"))
        folder.mkdir()
        try:
            environment = {**os.environ, "TMPDIR": str(folder)}
            done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, check=False)
            assert (done.returncode == 0) == works, done.stderr
        finally:
            subprocess.run(["rm", "-r", str(folder)], check=True)
