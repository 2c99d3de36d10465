"""One worker process, seen from the parent."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from pathlib import Path

from roslens.children.safe_path import python_words, safe_environment
from roslens.children.sandbox import Sandbox, text_of_sandbox
from roslens.plugins.frames import LOST_CONNECTION, AnswerBuffer, Began
from roslens.plugins.job import Job

_OUTPUT_KEPT = 1 << 20
"""Bytes of output that one step may add to the log; the rest of what it printed is left out."""

_START = """\
from roslens.children.lifeline import end_with_parent
end_with_parent({parent})
from roslens.plugins.worker import main
main({sandbox!r})"""


class WorkerProcess:
    """A process, the job it is at, and since when."""

    def __init__(self, output: Path, hash_seed: str, sandbox: Sandbox | None = None) -> None:
        """Start a process whose output, and that of its children, goes to the file ``output``.

        It confines itself to ``sandbox`` before it loads anything.
        """
        self.job: Job | None = None
        self.at: Began | None = None
        self.deadline = 0.0
        self.buffer = AnswerBuffer()
        self.homes: set[str] = set()
        self._output = output
        self._read = 0
        confined = text_of_sandbox(sandbox) if sandbox is not None else ""
        start = _START.format(parent=os.getpid(), sandbox=confined)
        with output.open("ab") as stream:
            self._process = subprocess.Popen(
                python_words(sys.executable, start, path=sys.path),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=stream,
                bufsize=0,
                start_new_session=True,
                env=safe_environment({**os.environ, "PYTHONHASHSEED": hash_seed}),
            )
        assert self._process.stdin is not None  # noqa: S101 - Popen was asked for pipes
        assert self._process.stdout is not None  # noqa: S101
        self._stdin = self._process.stdin
        self._stdout = self._process.stdout
        self.stdout = self._stdout.fileno()

    def start(self, job: Job, deadline: float) -> None:
        """Give it a job; one that is dead says so when it is listened to."""
        self.job, self.at, self.deadline = job, None, deadline
        self.buffer.begin()
        rest = memoryview(job.order())
        try:
            while rest:
                rest = rest[self._stdin.write(rest) or 0 :]
        except OSError:
            return

    def new_output(self, until: int = -1) -> str:
        """Return what was printed since the last call, up to the byte ``until`` unless that is negative."""
        size = self._output.stat().st_size if self._output.exists() else 0
        if until >= 0:
            size = min(size, until)
        if size <= self._read:
            return ""
        start = max(self._read, size - _OUTPUT_KEPT)
        with self._output.open("rb") as stream:
            stream.seek(start)
            content = stream.read(size - start)
        skipped = f"({start - self._read} bytes left out)\n" if start > self._read else ""
        self._read = size
        return skipped + content.decode("utf-8", "backslashreplace")

    def ended(self) -> str:
        """Return why the process is no longer there."""
        try:
            code = self._process.wait(1.0)
        except subprocess.TimeoutExpired:
            code = LOST_CONNECTION
        if code == LOST_CONNECTION:
            return "it closed the connection to roslens"
        if code >= 0:
            return f"its process ended with exit code {code}"
        try:
            name = signal.Signals(-code).name
        except ValueError:
            name = f"signal {-code}"
        return f"its process was ended by {name}"

    def kill(self) -> None:
        """End the process with everything it started."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._stdin.close()
        self._stdout.close()
        self._process.wait()
