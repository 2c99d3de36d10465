"""One mutant on trial: tests are run in a forked process, in a copy of the repository that it was written into."""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import sys
import time
import traceback
from pathlib import Path

import pytest

_REWRITTEN = "ignore::pytest.PytestAssertRewriteWarning"
LEFT_OUT = "not slow and not nightly and not browser and not corpora and not real and not heavy"
KILLED, SURVIVED, ENDLESS, BROKEN = "killed", "survived", "endless", "broken"


def tried(copy: Path, tests: list[str], seconds: float, report: Path) -> str:
    """Run tests in a copy; return what became of the mutant in it.

    Args:
        copy: of the repository, with the mutant.
        tests: files, the most promising first.
        seconds: of the processor, from which on it is endless; waiting may take ten times as long.
        report: a file for what the tests print.
    """
    sys.stdout.flush()
    pid = os.fork()
    if pid == 0:
        _become(copy, tests, seconds, report)
    end = time.monotonic() + 10 * seconds
    status = None
    while status is None:
        done, found = os.waitpid(pid, os.WNOHANG)
        if done:
            status = found
        elif time.monotonic() > end:
            _kill_group(pid)
            os.waitpid(pid, 0)
            return ENDLESS
        else:
            time.sleep(0.02)
    _kill_group(pid)
    if os.WIFSIGNALED(status):
        return ENDLESS if os.WTERMSIG(status) in (signal.SIGXCPU, signal.SIGKILL) else KILLED
    code = os.WEXITSTATUS(status)
    if code in (pytest.ExitCode.USAGE_ERROR, pytest.ExitCode.NO_TESTS_COLLECTED):
        # A mutant that cannot be imported by conftest.py ends so.
        return KILLED if "Error" in report.read_text("utf-8", "replace") else BROKEN
    return SURVIVED if code == 0 else KILLED


def _become(copy: Path, tests: list[str], seconds: float, report: Path) -> None:
    code = 99
    try:
        os.setsid()
        with report.open("w") as file:
            for number in (1, 2):
                os.dup2(file.fileno(), number)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
        os.chdir(copy)
        sys.path[:0] = [str(copy / "src"), str(copy / "tests")]
        os.environ["PYTHONPATH"] = str(copy / "src")
        words = ["-x", "-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-W", _REWRITTEN, "--tb=line", "-m", LEFT_OUT]
        code = int(pytest.main([*words, "--basetemp", str(copy.parent / f"{copy.name}-temporary"), *tests]))
    except BaseException:  # noqa: BLE001 - nothing of the process that was forked may go on in this one
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)


def _kill_group(pid: int) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(pid, signal.SIGKILL)
