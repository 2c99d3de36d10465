"""A process that reads files of strangers for one that goes on: a file that ends it costs itself alone.

What `check` does as a whole, servers do for each question: the kernel bounds the process that reads, and this one finds
in memory that both share which file was in hand when it ended. The question is asked again, of a new process that
leaves out that file; it leaves it out of later questions too, until the file is another one.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import pickle
import select
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, TypeVar, cast

from roslens.children.safe_path import NEUTRAL, python_words, safe_environment
from roslens.intake.file_budget import Slot, is_watched, refuse_only, refused, share_memory, watch, why_ended

Result = TypeVar("Result")
Heard = Callable[..., None]
_State = tuple[int, int, int]

_START = """\
from roslens.children.lifeline import end_with_parent, leave_interrupts
leave_interrupts()
end_with_parent({parent})
from roslens.source.engines.watched_reader import answer
answer({slot}, {jobs}, {idle})"""

_HEARD, _RESULT, _ERROR, _NONE = range(4)


class LostReaderError(RuntimeError):
    """The process that read ended, and no file that it read was why; the next question has another one."""


class WatchedReader:
    """Answers questions in a process of its own, one after the other; it is started by the first question."""

    def __init__(self, root: str = "", *, jobs: int = 0, idle_s: float = 0.0) -> None:
        """Start nothing yet.

        Args:
            root: folder to which paths of files are relative; may be set to another one between questions.
            jobs: how many processes share the memory that files may take; 0 for one for each processor.
            idle_s: seconds without a question after which the process ends; 0 for never. The next one starts another.
        """
        self.root = root
        self._jobs = jobs
        self._idle_s = idle_s
        self._turn = threading.Lock()
        self._process: _Process | None = None
        self._left_out: dict[str, tuple[str, _State]] = {}

    def ask(self, function: Callable[..., Result], *given: object, heard: Heard | None = None) -> Result:
        """Return what a function of a module makes of arguments, both of which can be pickled.

        Args:
            function: is called with ``given``, and with a function before them if ``heard`` is given.
            given: arguments.
            heard: is called here with what ``function`` calls its first argument with.

        Raises:
            LostReaderError: the process ended, and not by a file.
            Exception: what the function raises.
        """
        return cast("Result", self.ask_pickled(pickle.dumps((function, given, heard is not None)), heard))

    def ask_pickled(self, question: bytes, heard: Heard | None = None) -> object:
        """Ask as :meth:`ask` does, for what others pickled: a function, its arguments and whether it is heard."""
        with self._turn:
            since = time.time_ns()
            ended = dict[str, str]()
            while True:
                left_out = {**self._still_left_out(), **ended}
                process = self._started()
                kind, answered, exceeded = process.ask(pickle.dumps(left_out) + question, heard)
                if kind in (_RESULT, _ERROR):
                    self._keep({subject: why for subject, why in exceeded.items() if subject not in left_out}, since)
                    if kind == _ERROR:
                        raise cast("BaseException", answered)
                    return answered
                why, subject = process.why_ended()
                self._process = None
                if not why or not subject or subject in left_out:
                    raise LostReaderError(f"the process that read ended with exit code {process.code}")
                ended[subject] = why
                self._keep({subject: why}, since)

    def start(self) -> None:
        """Start the process now; it ends with the thread that does."""
        with self._turn:
            self._started()

    def end(self) -> None:
        """End the process."""
        if self._process is not None and self._process.owner == os.getpid():
            self._process.end()
        self._process = None

    def _started(self) -> _Process:
        # A copy of this process has no reader, and one ends with the thread that started it.
        if self._process is not None and self._process.owner == os.getpid() and not self._process.alive:
            self._process.end()
            self._process = None
        if self._process is None or self._process.owner != os.getpid():
            self._process = _Process(self._jobs, self._idle_s)
        return self._process

    def _still_left_out(self) -> dict[str, str]:
        self._left_out = {
            subject: (why, state) for subject, (why, state) in self._left_out.items() if state == self._state(subject)
        }
        return {subject: why for subject, (why, _) in self._left_out.items()}

    def _keep(self, exceeded: dict[str, str], since_ns: int) -> None:
        """Leave these out of later questions, but for what is no file or was written since the question."""
        for subject, why in exceeded.items():
            state = self._state(subject)
            if state is not None and state[0] < since_ns:
                self._left_out[subject] = (why, state)

    def _state(self, subject: str) -> _State | None:
        """Return what changes with a file; what is called after one, such as its program, goes with it."""
        for name in (subject, subject.rpartition(" (")[0]):
            with contextlib.suppress(OSError, ValueError):
                found = Path(self.root, name).stat() if name else None
                if found is not None:
                    return found.st_mtime_ns, found.st_size, found.st_ino
        return None


def read_watched(root: str, function: Callable[..., Result], *given: object) -> Result:
    """Return what a function makes of arguments: here if another process watches this one, else in one of its own.

    Args:
        root: folder to which paths of files are relative.
        function: of a module.
        given: arguments, which can be pickled.

    Raises:
        LostReaderError: the process ended, and not by a file.
        Exception: what the function raises.
    """
    if is_watched():
        return function(*given)
    reader = WatchedReader(root)
    try:
        return reader.ask(function, *given)
    finally:
        reader.end()


class _Process:
    """The process, and who started it."""

    def __init__(self, jobs: int, idle_s: float) -> None:
        self.owner = os.getpid()
        self._slot = Slot(shared=True)
        handed = self._slot.descriptor
        self._process = subprocess.Popen(
            python_words(
                sys.executable,
                _START.format(parent=self.owner, slot=handed, jobs=jobs, idle=idle_s),
                path=sys.path,
            ),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            cwd=NEUTRAL,
            bufsize=0,
            env=safe_environment(os.environ),
            pass_fds=() if handed is None else (handed,),
        )
        self._end = partial(_end, self._process, self.owner)
        atexit.register(self._end)

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    @property
    def code(self) -> int | None:
        return self._process.returncode

    def ask(self, question: bytes, heard: Heard | None) -> tuple[int, object, dict[str, str]]:
        """Return the kind of the answer, the answer, and what exceeded its budget; another kind where there is none."""
        try:
            _write(_descriptor(self._process.stdin), question)
            while body := _read(_descriptor(self._process.stdout)):
                kind, answered, exceeded = pickle.loads(body)  # noqa: S301 - of this program
                if kind != _HEARD:
                    return kind, answered, exceeded
                if heard is not None:
                    heard(*answered)
        except OSError:
            pass
        except BaseException:
            self.end()
            raise
        return _NONE, None, {}

    def why_ended(self) -> tuple[str, str]:
        """Return by what a process ended that is gone, and what it had in hand; each empty where there is none."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(5)
        self.end()
        return why_ended(self._process.returncode), self._slot.get()[1]

    def end(self) -> None:
        self._end()
        atexit.unregister(self._end)
        self._slot.close()


def _end(process: subprocess.Popen[bytes], owner: int) -> None:
    if owner != os.getpid():
        return
    with contextlib.suppress(OSError):
        process.kill()
    process.wait()
    for stream in (process.stdin, process.stdout):
        if stream is not None:
            stream.close()


def answer(slot: int | None, jobs: int, idle_s: float) -> None:
    """Answer questions on standard input, until it is closed or none comes for so many seconds (0: however long).

    What is printed meanwhile goes to standard error.
    """
    answers = os.dup(1)
    os.dup2(2, 1)
    share_memory(jobs)
    if slot is not None:
        watch(Slot.at(slot))
    while _is_asked(idle_s) and (body := _read(0)):
        _write(answers, _answered(body, answers))


def _is_asked(idle_s: float) -> bool:
    # Elsewhere a pipe cannot be waited for: there it ends with the process that asks.
    return not idle_s or os.name != "posix" or bool(select.select([0], [], [], idle_s)[0])


def _answered(body: bytes, answers: int) -> bytes:
    import io

    question = io.BytesIO(body)
    left_out = pickle.load(question)  # noqa: S301 - of the program that started this one
    # What this process found by itself may have changed meanwhile.
    refuse_only(left_out)

    def tell(*told: object) -> None:
        _write(answers, pickle.dumps((_HEARD, told, {})))

    try:
        function, given, is_heard = pickle.load(question)  # noqa: S301 - of the program that started this one
        answered = function(tell, *given) if is_heard else function(*given)
        return pickle.dumps((_RESULT, answered, dict(refused())))
    except Exception as error:  # noqa: BLE001 - who asked has it
        return _pickled(error)


def _pickled(error: Exception) -> bytes:
    """Return an error as it can be told; as its text where it cannot be made again."""
    try:
        body = pickle.dumps((_ERROR, error, dict(refused())))
        pickle.loads(body)  # noqa: S301 - it was made here
    except Exception:  # noqa: BLE001 - whatever its class does
        return pickle.dumps((_ERROR, RuntimeError(f"{type(error).__name__}: {error}"), dict(refused())))
    return body


def _descriptor(stream: Any) -> int:
    assert stream is not None  # noqa: S101 - Popen was asked for pipes
    return int(stream.fileno())


def _write(descriptor: int, body: bytes) -> None:
    rest = memoryview(len(body).to_bytes(8, "big") + body)
    while rest:
        rest = rest[os.write(descriptor, rest) :]


def _read(descriptor: int) -> bytes:
    """Return the next message; nothing at the end."""
    head = _piece(descriptor, 8)
    size = int.from_bytes(head, "big")
    body = _piece(descriptor, size) if len(head) == 8 else b""
    return body if len(body) == size else b""


def _piece(descriptor: int, size: int) -> bytes:
    pieces = bytearray()
    while len(pieces) < size:
        piece = os.read(descriptor, min(size - len(pieces), 1 << 20))
        if not piece:
            break
        pieces += piece
    return bytes(pieces)
