"""An adapter that runs as a process of its own, seen from roslens: started, read, started again when it ends."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import deque
from collections.abc import Mapping, Sequence
from pathlib import Path

from roslens.children.safe_path import NEUTRAL, python_words
from roslens.live.inside.environment import undone
from roslens.live.inside.slots import VARIABLE as COUNTERS
from roslens.live.publish.downlink import Downlink
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.wire import Frame, FrameReader, WireError

FIRST_PAUSE_S = 0.5
LONGEST_PAUSE_S = 30.0
HEALTHY_S = 30.0
"""A process that lived so long is started again at once, as if it were the first time."""
_PIECE = 1 << 16
_LINES = 20
_STOP_S = 3.0
_PROBE_S = 20.0
_BOOTSTRAPPED = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"
_PARENT = str(Path(__file__).parents[3])
# What the other Python brings itself goes first: folders of another version may hold libraries that it cannot load.
_START = "sys.path.append({parent!r}); from {module} import main; sys.exit(main(sys.argv[1:]))"
_ROS2 = "roslens.live.adapters.ros2.__main__"
VARIABLE = "ROSLENS_ROS2_PYTHON"


def clean_environment(base: Mapping[str, str]) -> dict[str, str]:
    """Return the environment for another Python: without the hooks, and without what ROS wheels set for this one."""
    found = dict(base)
    for name, value in undone(base).items():
        if name == COUNTERS:  # the folder stays: the adapter reads in it
            continue
        found.pop(name, None)
        if value is not None:
            found[name] = value
    if found.pop(_BOOTSTRAPPED, None) is not None:
        found.pop("LD_LIBRARY_PATH", None)
    return found


def find_ros2_python(option: str, environment: Mapping[str, str]) -> str:
    """Return a Python in which rclpy and msgspec import.

    Args:
        option: what the user named; empty for nothing.
        environment: of this process.

    Raises:
        UsageError: there is none; the text states what was tried and why it does not do.
    """
    named = option or environment.get(VARIABLE, "")
    tried = []
    for python in (named,) if named else (sys.executable, "python3"):
        reason = _unfit(python, environment)
        if not reason:
            return python
        tried.append(f"{python}: {reason}")
    raise UsageError(
        "no Python with rclpy: " + "; ".join(tried),
        expected="one in which rclpy and msgspec can be imported",
        advice=f"Source the setup file of ROS 2 first, or name a Python in ${VARIABLE}",
    )


def _unfit(python: str, environment: Mapping[str, str]) -> str:
    code = f"sys.path.append({_PARENT!r}); import rclpy, msgspec"
    try:
        ended = subprocess.run(
            python_words(python, code), env=clean_environment(environment), capture_output=True, text=True,
            timeout=_PROBE_S, cwd=NEUTRAL, check=False, stdin=subprocess.DEVNULL,
        )  # fmt: skip
    except OSError as error:
        return error.strerror or str(error)
    except subprocess.TimeoutExpired:
        return f"no answer in {_PROBE_S:.0f} s"
    return "" if not ended.returncode else (ended.stderr.strip().splitlines() or [f"exit code {ended.returncode}"])[-1]


def ros2_command(python: str, words: Sequence[str], module: str = _ROS2) -> list[str]:
    """Return the command that runs ``main`` of a module, by default that which observes ROS 2, in another Python."""
    return python_words(python, _START.format(parent=_PARENT, module=module), words)


class Child:
    """A process that speaks frames.

    Nothing here waits: ``poll`` reads what is there. A process that ends is started again after a pause, which doubles
    from 0.5 s up to 30 s as long as none of them lives for 30 s.

    Args:
        name: of the adapter, for messages.
        command: what to run.
        environment: to run it in.
        downlink: what is written to its standard input; None where nothing is.
    """

    def __init__(
        self, name: str, command: Sequence[str], environment: Mapping[str, str], downlink: Downlink | None = None
    ) -> None:
        self._name = name
        self._command = list(command)
        self._environment = clean_environment(environment)
        self._downlink = downlink
        self._process: subprocess.Popen[bytes] | None = None
        self._reader = FrameReader()
        self._partial = b""
        self._lines: deque[str] = deque(maxlen=_LINES)
        self._reported: set[str] = set()
        self._pause = FIRST_PAUSE_S
        self._begun = 0.0
        self._due = float("-inf")
        self.starts = 0

    def fileno(self) -> int | None:
        """Return the descriptor that becomes readable with the next frame; None while no process runs."""
        return self._process.stdout.fileno() if self._process and self._process.stdout else None

    def poll(self, now: float) -> list[Frame | Failure]:
        """Return what came since the last call; ``now`` is seconds on any clock that does not jump."""
        if self._process is None:
            return self._start(now) if now >= self._due else []
        # Asked before the last is read: what it wrote before it ended is then there.
        code = self._process.poll()
        found = self._frames()
        found += self._complaints()
        if code is not None and self._process is not None:
            found.append(self._ended(code, now))
        return found

    def end(self) -> None:
        """Ask the process to end (SIGTERM), without waiting for it."""
        if self._process is not None:
            self._process.terminate()

    def close(self) -> None:
        """End the process: by SIGTERM, and by SIGKILL where it is still there 3 s later."""
        if self._process is None:
            return
        self.end()
        try:
            self._process.wait(_STOP_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._release()

    def _start(self, now: float) -> list[Frame | Failure]:
        self._begun = now
        self._reader = FrameReader()
        self._partial = b""
        self._lines.clear()
        self.starts += 1
        try:
            self._process = subprocess.Popen(
                self._command, env=self._environment, cwd=NEUTRAL,
                stdin=subprocess.DEVNULL if self._downlink is None else subprocess.PIPE,
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0,
            )  # fmt: skip
        except OSError as error:
            return [self._failure(f"{self._command[0]} cannot be started: {error.strerror}", now)]
        for stream in (self._process.stdout, self._process.stderr):
            if stream is not None:
                os.set_blocking(stream.fileno(), False)
        if self._downlink is not None and self._process.stdin is not None:
            self._downlink.attach(self._process.stdin)
        return []

    def _frames(self) -> list[Frame | Failure]:
        found: list[Frame | Failure] = []
        if self._process is None or self._process.stdout is None:
            return found
        while piece := _read(self._process.stdout.fileno()):
            try:
                found.extend(self._reader.feed(piece))
            except WireError as error:
                # Nothing that follows can be read; its end starts it anew.
                self._process.kill()
                self._lines.append(str(error))
                break
        return found

    def _complaints(self) -> list[Frame | Failure]:
        if self._process is None or self._process.stderr is None:
            return []
        while piece := _read(self._process.stderr.fileno()):
            self._partial += piece
        *whole, self._partial = self._partial.split(b"\n")
        self._partial = self._partial[-_PIECE:]
        lines = [text for line in whole if (text := line.decode("utf-8", "replace").strip())]
        self._lines.extend(lines)
        fresh = [line for line in dict.fromkeys(lines) if "error" in line.lower() and line not in self._reported]
        if len(self._reported) < 100:
            self._reported.update(fresh)
            return [Failure(self._name, line, partial=True) for line in fresh[:_LINES]]
        return []

    def _ended(self, code: int, now: float) -> Failure:
        how = f"exit code {code}" if code >= 0 else f"signal {-code}"
        self._lines.extend(filter(None, [self._partial.decode("utf-8", "replace").strip()]))
        self._release()
        return self._failure(f"the observer of {self._name} ended with {how}", now)

    def _failure(self, what: str, now: float) -> Failure:
        if now - self._begun >= HEALTHY_S:
            self._pause = FIRST_PAUSE_S
        pause, self._pause = self._pause, min(2 * self._pause, LONGEST_PAUSE_S)
        self._due = now + pause
        last = f": {self._lines[-1]}" if self._lines else ""
        return Failure(
            self._name, f"{what}{last}", "a process that runs until it is stopped",
            f"It is started again in {pause:g} s", detail="\n".join(self._lines),
        )  # fmt: skip

    def _release(self) -> None:
        if self._process is not None:
            for stream in (self._process.stdout, self._process.stderr):
                if stream is not None:
                    stream.close()
        if self._downlink is not None:
            self._downlink.detach()
        self._process = None


def _read(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, _PIECE)
    except BlockingIOError:
        return b""
