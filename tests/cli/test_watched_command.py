"""A file that only the kernel ends costs itself alone: the command starts again without it; signals reach it once."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from pace import slowness

from roslens.cli.main import COMMANDS
from roslens.cli.terminal.watched_command import UNWATCHED, WATCHED

MANIFEST = """<package format="3"><name>{}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.org">A</maintainer><license>MIT</license></package>
"""
PATCHED = """
import ctypes, os, signal, sys
import roslens.source.measure.analyse_package as analyse
import roslens.source.workspace.manifest as manifest

def hostile(content):
    if b"of_time" in content:
        # As a call into C that looks at nothing.
        signal.pthread_sigmask(signal.SIG_BLOCK, set(range(1, 65)) - {signal.SIGXCPU})
        while True:
            pass
    if b"of_memory" in content:
        os.abort()

def patched(module, name):
    real = getattr(module, name)

    def read(content, *rest):
        hostile(content)
        return real(content, *rest)

    setattr(module, name, read)

analyse.SOURCE_FILE_S = 1.0
patched(analyse, "parse_file")
patched(manifest, "read_elements")
from roslens.cli.entry import main
sys.exit(main())
"""


@pytest.fixture
def workspace(tmp_path):
    (tmp_path / "patched.py").write_text(PATCHED)
    for name in ("arm", "base"):
        package = tmp_path / "ws" / name
        package.mkdir(parents=True)
        (package / "package.xml").write_text(MANIFEST.format(name))
        (package / "good.cpp").write_text("int f() { return 1; }\n")
    return tmp_path / "ws"


def command(workspace, *words):
    return [sys.executable, str(workspace.parent / "patched.py"), "check", str(workspace), "--no-store", *words]


@pytest.mark.heavy
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_one_file_is_lost_and_named(workspace, jobs):
    (workspace / "arm/time.cpp").write_text("// of_time\n")
    (workspace / "arm/memory.cpp").write_text("// of_memory\n")
    words = ("--jobs", jobs, "--format", "json", "--no-cache", "--no-graph", "--model", "ros")
    done = subprocess.run(command(workspace, *words), capture_output=True, check=False, timeout=300)
    assert done.returncode == 3, done.stderr
    report = json.loads(done.stdout)
    reported = {one["path"]: one["what"] for one in report["failures"]}
    assert reported.keys() == {"arm/time.cpp", "arm/memory.cpp"}
    assert "s of processor time" in reported["arm/time.cpp"]
    assert "or breaks the parser" in reported["arm/memory.cpp"]


@pytest.mark.heavy
def test_so_is_a_manifest(workspace):
    (workspace / "arm/package.xml").write_text(MANIFEST.format("arm") + "<!-- of_memory -->\n")
    words = ("--jobs", "1", "--format", "json", "--no-cache", "--no-graph", "--model", "ros")
    done = subprocess.run(command(workspace, *words), capture_output=True, check=False, timeout=300)
    assert done.returncode == 3, done.stderr
    report = json.loads(done.stdout)
    (failure,) = [one for one in report["failures"] if "memory" in one["what"]]
    assert failure["path"] == "arm/package.xml"
    assert "the manifest is left out" in failure["what"]


@pytest.mark.heavy
@pytest.mark.parametrize(
    "words",
    [
        ["interfaces", "--lock", "lock.json"],
        ["port", "humble", "jazzy"],
        ["completion", "launches", "--path"],
        ["report", "--no-store", "--no-graph", "-o", "out"],
    ],
    ids=lambda words: words[0],
)
def test_other_commands_that_read_a_workspace_lose_it_alone(workspace, words):
    (workspace / "arm/package.xml").write_text(MANIFEST.format("arm") + "<!-- of_memory -->\n")
    name, *more = words
    line = [sys.executable, str(workspace.parent / "patched.py"), name, *more, str(workspace)]
    done = subprocess.run(line, capture_output=True, check=False, timeout=300, cwd=workspace.parent, text=True)
    assert done.returncode in (0, 1, 3), (done.returncode, done.stderr)
    assert "Traceback" not in done.stderr


def test_each_command_is_watched_or_is_said_not_to_be():
    assert not WATCHED & UNWATCHED
    assert COMMANDS.keys() == WATCHED | UNWATCHED


def running(workspace, *words):
    """Return a check that is in a file without end, and the process that reads it."""
    (workspace / "arm/time.cpp").write_text("// of_time\n")
    return subprocess.Popen(
        command(workspace, "--jobs", "1", "--no-cache", "--no-graph", *words),
        stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, start_new_session=True,
    )  # fmt: skip


def children(pid):
    return [int(one) for one in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def begun(process):
    """Wait until the process that reads blocks all signals: it is in the file."""
    while True:
        for child in children(process.pid):
            lines = Path(f"/proc/{child}/status").read_text().splitlines()
            blocked = next(line for line in lines if line.startswith("SigBlk"))
            if int(blocked.split()[1], 16) & 1 << (signal.SIGUSR2 - 1):
                return child
        assert process.poll() is None
        os.sched_yield()


@pytest.mark.heavy
@pytest.mark.parametrize("how", ["term", "interrupt", "group"])
def test_a_process_that_hears_nothing_is_ended(workspace, how, monkeypatch):
    text = (workspace.parent / "patched.py").read_text()
    (workspace.parent / "patched.py").write_text(
        text.replace("analyse.SOURCE_FILE_S = 1.0", "analyse.SOURCE_FILE_S = 60.0")
    )
    process = running(workspace)
    child = begun(process)
    since = time.monotonic()
    if how == "group":
        os.killpg(process.pid, signal.SIGINT)
    else:
        process.send_signal(signal.SIGTERM if how == "term" else signal.SIGINT)
    assert process.wait(60) == 130
    assert time.monotonic() - since < 10 * slowness()
    assert process.stderr.read().strip().splitlines()[-1] == "roslens: interrupted; the last complete run is untouched"
    process.stderr.close()
    assert not Path(f"/proc/{child}").exists()


@pytest.mark.heavy
def test_the_process_that_reads_ends_with_the_one_that_watches_it(workspace):
    process = running(workspace)
    child = begun(process)
    process.kill()
    process.wait()
    process.stderr.close()
    end = time.monotonic() + 30
    while Path(f"/proc/{child}").exists():
        assert time.monotonic() < end
        os.sched_yield()
