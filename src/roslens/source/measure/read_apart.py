"""A large file is read in a process of its own, whose time and memory this one bounds from outside.

The parser's own time limit does not reach all of it: a query over the syntax tree is not interrupted, and the memory of
a tree can be a thousand times the size of what it is made from. Both grow with the file, so small ones stay within
bounds by their size; a large one is read by a process that the kernel ends (``RLIMIT_CPU``, ``RLIMIT_AS``), is named,
and the rest of its package goes on.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import select
import subprocess
import sys
import threading
import time

import msgspec

from roslens.children.limits import limit_processor
from roslens.children.safe_path import NEUTRAL, python_words, safe_environment
from roslens.intake.file_budget import MORE_S, is_watched, memory_of_file
from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError
from roslens.model.source import Language
from roslens.source.settings import MacroSettings

LARGE_BYTES, UNWATCHED_BYTES = 1 << 18, 1 << 15
"""Files with more are read apart, the second where no other process watches this one. Of those with less than the first
the most costly shape takes 600 MB, with less than the second 80 MB.
"""

_PATIENCE = 60
"""How many times as long a file may take by the clock, on a machine that gives it no processor."""

_START = """\
from roslens.children.lifeline import end_with_parent
end_with_parent({parent})
from roslens.source.measure.read_apart import serve
serve({memory})"""


def most_bytes_here() -> int:
    """Return how large a file may be that is read in this process."""
    return LARGE_BYTES if is_watched() else UNWATCHED_BYTES


class Asked(msgspec.Struct, frozen=True):
    """What is wanted of a file: its analysis for the rules ``wanted`` (None for all), its program, or both."""

    content: bytes
    language: Language
    macros: MacroSettings
    analysis: bool = False
    program: bool = False
    wanted: frozenset[str] | None = None


class Given(msgspec.Struct, frozen=True):
    """What was read, encoded; or why not: ``over`` if it exceeds its budget, ``broken`` for anything else."""

    analysis: bytes = b""
    program: bytes = b""
    over: str = ""
    broken: str = ""


class BrokenError(Exception):
    """The process that read a file failed on it; the text is that of its error."""


def read_apart(asked: Asked) -> Given:
    """Return what was read of a file.

    Raises:
        OverBudgetError: it takes more time or memory than a file may.
        BrokenError: reading it failed in another way.
    """
    process = _process()
    given = process.ask(asked)
    if given.over:
        raise OverBudgetError(given.over)
    if given.broken:
        raise BrokenError(given.broken)
    return given


class _Apart:
    """The process, and who started it: a copy of this process has none."""

    def __init__(self) -> None:
        self.owner = os.getpid()
        self._turn = threading.Lock()
        self._memory = memory_of_file()
        self._process = subprocess.Popen(
            python_words(sys.executable, _START.format(parent=self.owner, memory=self._memory), path=sys.path),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=NEUTRAL,
            bufsize=0,
            env=safe_environment(os.environ),
        )

    def ask(self, asked: Asked) -> Given:
        """Return its answer, or why there is none: then it has ended."""
        with self._turn:
            return self._answered(asked)

    def _answered(self, asked: Asked) -> Given:
        try:
            # The kernel counts all that the process took so far.
            limit_processor(self._process.pid, self._taken_s() + SOURCE_FILE_S + MORE_S)
            _write(self._stdin, msgspec.msgpack.encode(asked))
            body = _read(self._stdout, time.monotonic() + _PATIENCE * SOURCE_FILE_S)
        except OSError:
            body = b""
        except BaseException:
            self.end()
            raise
        if body:
            return msgspec.msgpack.decode(body, type=Given)
        return Given(over=self._why())

    @property
    def alive(self) -> bool:
        """Whether the process is there."""
        return self._process.poll() is None

    def end(self) -> None:
        """End the process; one of the process that this is a copy of is left to it."""
        global _held
        if self.owner == os.getpid():
            with contextlib.suppress(OSError):
                self._process.kill()
            self._process.wait()
            for stream in (self._process.stdin, self._process.stdout):
                if stream is not None:
                    stream.close()
        _held = None

    @property
    def _stdin(self) -> int:
        assert self._process.stdin is not None  # noqa: S101 - Popen was asked for pipes
        return self._process.stdin.fileno()

    @property
    def _stdout(self) -> int:
        assert self._process.stdout is not None  # noqa: S101 - Popen was asked for pipes
        return self._process.stdout.fileno()

    def _taken_s(self) -> float:
        try:
            text = _content(f"/proc/{self._process.pid}/stat").rpartition(b")")[2].split()
            return (int(text[11]) + int(text[12])) / os.sysconf("SC_CLK_TCK")
        except (OSError, IndexError, ValueError):
            return 0.0

    def _why(self) -> str:
        import signal

        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(0.5)
        code = self._process.poll()
        self.end()
        if code is None:
            return f"it takes more than {_PATIENCE * SOURCE_FILE_S:g} s by the clock"
        if code == -signal.SIGXCPU:
            return f"it takes more than {SOURCE_FILE_S:g} s of processor time"
        return f"it needs more than {self._memory / 1e6:,.0f} MB of memory, or breaks the parser"


_held: _Apart | None = None


def _process() -> _Apart:
    global _held
    # It ends with the thread that started it, too.
    if _held is None or _held.owner != os.getpid() or not _held.alive:
        _held = _Apart()
        atexit.register(_held.end)
    return _held


def serve(memory_bytes: int) -> None:
    """Read files that are asked for on standard input, until it is closed."""
    if sys.platform != "win32":
        import resource

        for limit, most in ((resource.RLIMIT_AS, memory_bytes), (resource.RLIMIT_CORE, 0)):
            with contextlib.suppress(OSError, ValueError):
                resource.setrlimit(limit, (most, most))
    answers = os.dup(1)
    os.dup2(2, 1)
    while body := _read(0):
        _write(answers, msgspec.msgpack.encode(_given(msgspec.msgpack.decode(body, type=Asked))))


def _given(asked: Asked) -> Given:
    from roslens.intake.time_budget import time_budget

    try:
        with time_budget(SOURCE_FILE_S):
            return _read_file(asked)
    except OverBudgetError as error:
        return Given(over=str(error))
    except MemoryError:
        return Given(over=f"it needs more than {memory_of_file() / 1e6:,.0f} MB of memory")
    except Exception as error:  # noqa: BLE001 - whatever it is, it is this file's
        return Given(broken=f"{type(error).__name__}: {error}")


def _read_file(asked: Asked) -> Given:
    from roslens.source.extract.ir.program_codec import pack
    from roslens.source.measure.analyse_file import analyse_parsed
    from roslens.source.parsed_file import parse_file

    parsed = parse_file(asked.content, asked.language, asked.macros)
    analysis = b""
    if asked.analysis:
        analysis = msgspec.msgpack.encode(analyse_parsed(asked.content, parsed, asked.wanted))
    return Given(analysis, pack(parsed.program()) if asked.program else b"")


def _content(path: str) -> bytes:
    opened = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    try:
        return os.read(opened, 4096)
    finally:
        os.close(opened)


def _write(descriptor: int, body: bytes) -> None:
    rest = memoryview(len(body).to_bytes(8, "big") + body)
    while rest:
        rest = rest[os.write(descriptor, rest) :]


def _read(descriptor: int, deadline: float = 0.0) -> bytes:
    """Return the next message; nothing at the end, or after the deadline where there is one."""
    head = _piece(descriptor, 8, deadline)
    return _piece(descriptor, int.from_bytes(head, "big"), deadline) if len(head) == 8 else b""


def _piece(descriptor: int, size: int, deadline: float) -> bytes:
    pieces = bytearray()
    while len(pieces) < size:
        if deadline and not select.select([descriptor], [], [], max(0.0, deadline - time.monotonic()))[0]:
            return b""
        piece = os.read(descriptor, min(size - len(pieces), 1 << 20))
        if not piece:
            return b""
        pieces += piece
    return bytes(pieces)
