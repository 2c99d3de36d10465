"""No process outlives the one that started it, however that one ended; requests to end are heard."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = [
    pytest.mark.timed,
    pytest.mark.skipif(sys.platform != "linux", reason="/proc tells which processes are there"),
]

HEARS = """\
import signal
signal.signal(signal.SIGHUP, signal.SIG_DFL)
"""
"""What is started below `nohup` hears no SIGHUP unless it says so."""

POOL = """
import time
from roslens.children.worker_pool import worker_pool
if __name__ == "__main__":
    with worker_pool(2, {method!r}) as pool:
        found = [pool.submit(time.sleep, 300) for _ in range(6)]
        print("begun", flush=True)
        found[0].result()
"""
PLUGIN = """
import sys
from pathlib import Path
from roslens.plugins.process import WorkerProcess
worker = WorkerProcess(Path(sys.argv[1]), "0")
print("begun", flush=True)
import time
time.sleep(300)
"""


def below(process):
    """Return all processes that descend from one, or are of its session."""
    parents = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if words[0] != "Z":
            parents[int(folder.name)] = int(words[1])
    found = {process}
    while more := {one for one, parent in parents.items() if parent in found} - found:
        found |= more
    return found - {process}


def are_there(processes):
    alive = set()
    for one in processes:
        try:
            state = Path(f"/proc/{one}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            continue
        if state != "Z":
            alive.add(one)
    return alive


def wait_until(condition, seconds=30.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not come about"
        time.sleep(0.02)


def ended_within(process, seconds):
    """Wait for a process to end; one that does not is ended, or leaving its context would wait for ever."""
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        raise


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize(
    ("code", "children"),
    [(POOL.format(method="fork"), 2), (POOL.format(method="forkserver"), 4), (PLUGIN, 1)],
    ids=["fork", "forkserver", "plug-in"],
)
def test_nobody_is_left(tmp_path, code, children, how):
    script = tmp_path / "script.py"
    script.write_text(HEARS + code)
    with subprocess.Popen([sys.executable, str(script), str(tmp_path / "log")], stdout=subprocess.PIPE) as process:
        assert process.stdout.readline() == b"begun\n"
        wait_until(lambda: len(below(process.pid)) >= children)
        started = below(process.pid)
        process.send_signal(how)
        ended_within(process, 30)
    wait_until(lambda: not are_there(started))


GUARDED = """
import os, sys, time
from roslens.cli.terminal.boundary import guarded
def command():
    try:
        print("begun", flush=True)
        time.sleep(300)
    finally:
        print("undone", flush=True)
sys.exit(guarded(command, []))
"""


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_request_to_end_undoes_what_was_begun(how):
    with subprocess.Popen(
        [sys.executable, "-c", HEARS + GUARDED], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout.readline() == "begun\n"
        os.kill(process.pid, how)
        out, err = process.communicate(timeout=30)
    assert out == "undone\n"
    assert process.returncode == 130
    assert err == "roslens: interrupted; the last complete run is untouched\n"


def test_an_interrupted_pool_is_ended_and_not_waited_for(tmp_path):
    script = tmp_path / "script.py"
    script.write_text(POOL.format(method="forkserver"))
    with subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdout.readline() == b"begun\n"
        wait_until(lambda: len(below(process.pid)) >= 4)
        started = below(process.pid)
        process.send_signal(signal.SIGINT)
        ended_within(process, 30)
    wait_until(lambda: not are_there(started))
