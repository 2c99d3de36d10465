"""Ends of real processes that are no children of who looks."""

import os
import select
import signal
import subprocess
import sys

import pytest

from roslens.children import exit_status
from roslens.children.exit_status import how_it_ended

pytestmark = pytest.mark.timed

PARENT = """
import subprocess, sys
child = subprocess.Popen([sys.executable, "-c", sys.argv[1]], stdin=subprocess.PIPE)
print(child.pid, flush=True)
input()
child.stdin.close()
if len(sys.argv) > 2: input()
child.wait()
print("reaped", flush=True)
input()
"""


class Grandchild:
    """A process that another one starts and waits for."""

    def __init__(self, code, *words):
        command = [sys.executable, "-c", PARENT, code, *words]
        self.parent = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.pid = int(self.parent.stdout.readline())
        self.handle = os.pidfd_open(self.pid)

    def end(self):
        self.parent.stdin.write("\n")
        self.parent.stdin.flush()
        select.select([self.handle], [], [], 60)

    def close(self):
        os.close(self.handle)
        self.parent.kill()
        self.parent.communicate()


@pytest.mark.parametrize(
    ("code", "ended"),
    [
        ("input() if 0 else __import__('sys').stdin.read()", "exit 0"),
        ("__import__('sys').stdin.read(); raise SystemExit(3)", "exit 3"),
        ("import os, sys; sys.stdin.read(); os.kill(os.getpid(), 11)", "signal 11"),
        ("import os, sys; sys.stdin.read(); os.kill(os.getpid(), 15)", "signal 15"),
    ],
)
def test_how_a_process_ended_is_seen_before_and_after_its_parent_reaps_it(code, ended):
    unreaped = Grandchild(code, "late")
    unreaped.end()
    assert how_it_ended(unreaped.pid, unreaped.handle) == ended
    unreaped.close()
    reaped = Grandchild(code)
    reaped.end()
    assert reaped.parent.stdout.readline() == "reaped\n"
    # A kernel before 6.15 keeps nothing of it.
    assert how_it_ended(reaped.pid, reaped.handle) in (ended, "unknown")
    reaped.close()


def test_what_an_older_kernel_does_not_keep_is_unknown(monkeypatch, tmp_path):
    monkeypatch.setattr(exit_status, "_GET_INFO", 0)
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    handle = os.pidfd_open(child.pid)
    child.send_signal(signal.SIGKILL)
    select.select([handle], [], [], 60)
    assert how_it_ended(child.pid, handle) == "signal 9", "it is a zombie as yet"
    child.wait()
    assert how_it_ended(child.pid, handle, tmp_path) == "unknown"
    os.close(handle)
