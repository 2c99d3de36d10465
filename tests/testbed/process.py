"""A program that runs in a host: its process id, its output, its end and its next life."""

import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

START_LIMIT = 60.0
BURIAL_LIMIT = 2.0
STEP = 0.005


class Process:
    """One program in one host. Output goes to a file, so that a full pipe never stops it.

    Args:
        name: Names its log file.
        enter: The words that lead into the host, put before the command.
        command: Program and arguments.
        environment: The whole environment.
        log: File for standard output and error, appended to.
    """

    def __init__(
        self, name: str, enter: Sequence[str], command: Sequence[str], environment: Mapping[str, str], log: Path
    ) -> None:
        self.name = name
        self.command = list(command)
        self.environment = dict(environment)
        self.log = log
        self._enter = list(enter)
        self._spawn()

    def _spawn(self) -> None:
        with self.log.open("ab") as log:
            self._entering = subprocess.Popen(
                [*self._enter, *self.command],
                env=self.environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        self.pid = self._child()

    def _child(self) -> int:
        """The program's id: `nsenter` has to fork, because only a child enters a process namespace."""
        entering = self._entering.pid
        children = Path(f"/proc/{entering}/task/{entering}/children")
        deadline = time.monotonic() + START_LIMIT
        while self._entering.poll() is None and time.monotonic() < deadline:
            with contextlib.suppress(OSError):
                if found := children.read_text().split():
                    return int(found[0])
            time.sleep(STEP)
        return entering

    @property
    def inner_pid(self) -> int:
        """The process id as programs of the same host see it."""
        for line in Path(f"/proc/{self.pid}/status").read_text().splitlines():
            if line.startswith("NSpid:"):
                return int(line.split()[-1])
        raise ProcessLookupError(self.name)

    @property
    def running(self) -> bool:
        """Whether it has not ended; a frozen one runs."""
        return self.code is None

    @property
    def code(self) -> int | None:
        """Exit code, negative for a signal, None while it runs."""
        code = self._entering.poll()
        # nsenter stops itself along with its child, and does not notice when somebody else wakes or kills the child.
        if code is None and _state(self._entering.pid) == "T" and _state(self.pid) != "T":
            os.kill(self._entering.pid, signal.SIGCONT)
        return code

    def output(self) -> str:
        """All it has written so far, in all its lives."""
        return self.log.read_text(errors="replace")

    def send(self, number: signal.Signals) -> None:
        """Sends a signal to the program; nothing happens when it has ended."""
        if not self.running:
            return
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, number)

    def wait(self, limit: float) -> int:
        """Waits up to `limit` seconds for its end; raises subprocess.TimeoutExpired."""
        deadline = time.monotonic() + limit
        while (code := self.code) is None:
            if time.monotonic() > deadline:
                raise subprocess.TimeoutExpired(self.command, limit)
            time.sleep(STEP)
        return code

    def stop(self, limit: float = 5.0) -> None:
        """Asks it to end (SIGINT, what ROS nodes expect), and kills it after `limit` seconds."""
        self.send(signal.SIGINT)
        try:
            self.wait(limit)
        except subprocess.TimeoutExpired:
            self.kill()

    def kill(self) -> None:
        """Ends it at once, with whatever it has started."""
        self.send(signal.SIGKILL)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self.wait(
                BURIAL_LIMIT
            )  # nsenter has to bury it: a host cannot end with a dead process nobody has waited for
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._entering.pid, signal.SIGKILL)
        self._entering.wait()

    def start_again(self) -> None:
        """Starts the same command in the same environment; the process has to have ended."""
        if self.running:
            raise RuntimeError(f"{self.name!r} still runs as {self.pid}; stop or kill it first")
        self._spawn()


def _state(pid: int) -> str:
    """The letter that the kernel gives a process: R, S, T... or nothing when there is none."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return ""
