"""A foreign program, run once: bounded in time and in what it may print, and gone when roslens is."""

from __future__ import annotations

import contextlib
import os
import selectors
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from threading import Lock

import msgspec

from roslens.children.lifeline import words_with_lifeline
from roslens.children.limits import limit_processor
from roslens.children.safe_path import python_words, safe_environment, without_current_folder
from roslens.children.sandbox import (
    BUBBLEWRAP,
    LANDLOCK,
    Sandbox,
    bubblewrap_words,
    environment_of,
    sandbox_kind,
    text_of_sandbox,
)
from roslens.children.session import number_in_session

MOST_BYTES = 64 * 1024 * 1024
"""Bytes that one process may print; one that prints more is ended and its output is not looked at."""

_KEPT_IN_MESSAGE = 300
_LOOK_S = 0.2
_STARTING_S = 0.3
"""Of a processor, until the process confined itself and is the program."""

_LONGEST_WORD = 60_000
"""Characters of one word of a command; the kernel takes 128 KiB."""

_START = """\
import os
from roslens.children.lifeline import end_with_parent
end_with_parent({parent})
{confined}os.execv(sys.argv[1], sys.argv[1:])"""

_CONFINED = """\
from roslens.children.sandbox import confine, sandbox_of_text
confine(sandbox_of_text({sandbox!r}))
"""
_VARIABLES = "os.environ.update({environment!r})\n"


_NONE: Mapping[str, str] = {}


class ToolError(Exception):
    """A tool did not do what it was started for; the text continues a sentence that begins with its name."""


class ToolHangError(ToolError):
    """It did not end in time."""


class ToolTalkError(ToolError):
    """It printed more than is read."""


class Ended(msgspec.Struct, frozen=True):
    """What a process left: its exit code (negative for a signal) and what it printed."""

    code: int
    stdout: bytes
    stderr: bytes

    def complaint(self) -> str:
        """Return the last line that it printed on standard error, or else on standard output, for a message."""
        for output in (self.stderr, self.stdout):
            lines = output[-4096:].decode("utf-8", "replace").strip().splitlines()
            if lines:
                return lines[-1].strip()[:_KEPT_IN_MESSAGE]
        return "it printed nothing"


class ToolRunner:
    """Runs programs, from any thread; :meth:`end_all` ends those that are still at it."""

    def __init__(self, *, most_bytes: int = MOST_BYTES) -> None:
        """Let one process print at most ``most_bytes``."""
        self._most_bytes = most_bytes
        self._running: set[subprocess.Popen[bytes]] = set()
        self._lock = Lock()
        self._over = False
        self.started = 0

    def run(
        self,
        words: Sequence[str],
        *,
        folder: str,
        time_limit_s: float,
        safe_path: bool = True,
        environment: Mapping[str, str] | None = None,
        most_processes: int = 0,
        sandbox: Sandbox | None = None,
        processor_s: float = 0.0,
        variables: Mapping[str, str] = _NONE,
    ) -> Ended:
        """Run a program to its end and return what it left.

        It hears nothing on standard input, and imports no Python module from the folder it is started in; one in a
        sandbox none from what the sandbox lets it read.

        Args:
            words: the program's absolute path and its arguments.
            folder: the current folder of the process.
            time_limit_s: seconds after which it is ended with everything it started.
            safe_path: whether a Python that it starts leaves the folder of its script off the path, too.
            environment: its variables, where they are not those of this process.
            most_processes: with how many more at once it is ended; 0 for any number, as where the kernel tells none.
            sandbox: what it may touch; None for all that this process may. Its first folder to write is its home.
            processor_s: seconds of a processor after which the kernel ends it; 0 for none.
            variables: of its environment, where they are others than those of this process or of ``environment``.

        Raises:
            ToolError: it could not be started, did not end in time, or printed too much.
        """
        try:
            process = subprocess.Popen(
                _confined(words, sandbox),
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                start_new_session=True,
                env={**(environment or _environment(os.environ, safe_path=safe_path)), **variables},
            )
        except OSError as error:
            raise ToolError(f"cannot be started: {error.strerror}") from error
        if processor_s:
            limit_processor(process.pid, processor_s + _STARTING_S)
        with self._lock:
            self._running.add(process)
            self.started += 1
            over = self._over
        try:
            if over:
                raise ToolError("was not run: the command is being ended")
            return self._followed(process, time.monotonic() + time_limit_s, time_limit_s, most_processes)
        finally:
            _end(process)
            with self._lock:
                self._running.discard(process)

    def end_all(self) -> None:
        """End every process that runs now, and let none be started any more."""
        with self._lock:
            self._over = True
            running = list(self._running)
        for process in running:
            _end_group(process)

    def _followed(
        self, process: subprocess.Popen[bytes], deadline: float, time_limit_s: float, most_processes: int
    ) -> Ended:
        assert process.stdout is not None  # noqa: S101 - Popen was asked for pipes
        assert process.stderr is not None  # noqa: S101
        taken: dict[int, list[bytes]] = {process.stdout.fileno(): [], process.stderr.fileno(): []}
        size, next_look = 0, time.monotonic() + _LOOK_S
        with selectors.DefaultSelector() as selector:
            for descriptor in taken:
                selector.register(descriptor, selectors.EVENT_READ)
            while selector.get_map():
                left = deadline - time.monotonic()
                ready = selector.select(max(0.0, min(left, _LOOK_S) if most_processes else left))
                if most_processes and time.monotonic() >= next_look:
                    next_look = time.monotonic() + _LOOK_S
                    _refuse_many(process.pid, most_processes)
                if not ready and deadline <= time.monotonic():
                    raise ToolHangError(f"did not end within {time_limit_s:g} s")
                size += _read([key.fd for key, _ in ready], selector, taken)
                if size > self._most_bytes:
                    raise ToolTalkError(f"printed more than {self._most_bytes:,} bytes")
        try:
            code = process.wait(max(0.1, deadline - time.monotonic()))
        except subprocess.TimeoutExpired:
            raise ToolHangError(f"did not end within {time_limit_s:g} s") from None
        stdout, stderr = (b"".join(pieces) for pieces in taken.values())
        return Ended(code, stdout, stderr)


def _refuse_many(leader: int, most: int) -> None:
    if (many := number_in_session(leader)) > most:
        raise ToolError(f"started {many} processes, which would go on and on")


def _confined(words: Sequence[str], sandbox: Sandbox | None) -> list[str]:
    """Return the command that runs words in a sandbox, and ends with this process."""
    if sandbox is None and (alive := words_with_lifeline(words)) is not None:
        return alive
    confined = ""
    if sandbox is not None:
        confined = _VARIABLES.format(environment=environment_of(sandbox))
        if sandbox_kind() == LANDLOCK:
            confined = _CONFINED.format(sandbox=_kept(text_of_sandbox(sandbox), sandbox)) + confined
        elif sandbox_kind() == BUBBLEWRAP:
            words = [*bubblewrap_words(sandbox), *words]
    return python_words(sys.executable, _START.format(parent=os.getpid(), confined=confined), words, sys.path)


def _kept(text: str, sandbox: Sandbox) -> str:
    """Return the text, or the path of a file with it where it is too long for a command line."""
    if len(text) < _LONGEST_WORD or not sandbox.write:
        return text
    path = Path(sandbox.write[0], ".sandbox.json")
    path.write_text(text, "utf-8")
    return str(path)


def ended_how(code: int) -> str:
    """Return an exit code as text for a message."""
    if code >= 0:
        return f"ended with exit code {code}"
    with contextlib.suppress(ValueError):
        return f"was ended by {signal.Signals(-code).name}"
    return f"was ended by signal {-code}"


def _environment(base: Mapping[str, str], *, safe_path: bool) -> dict[str, str]:
    """Return the environment of a tool: plain words without colours, in a fixed language."""
    plain = {**base, "LC_ALL": "C.UTF-8", "NO_COLOR": "1", "TERM": "dumb", "COLUMNS": "200"}
    return safe_environment(plain) if safe_path else without_current_folder(plain)


def _read(descriptors: Iterable[int], selector: selectors.BaseSelector, taken: dict[int, list[bytes]]) -> int:
    """Take what can be read, and leave what ended; return how many bytes came."""
    size = 0
    for descriptor in descriptors:
        piece = os.read(descriptor, 1 << 16)
        if not piece:
            selector.unregister(descriptor)
        taken[descriptor].append(piece)
        size += len(piece)
    return size


def _end(process: subprocess.Popen[bytes]) -> None:
    """End what is left of a process and of what it started, and close its pipes."""
    _end_group(process)
    for stream in (process.stdout, process.stderr):
        if stream is not None:
            stream.close()
    process.wait()


def _end_group(process: subprocess.Popen[bytes]) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
