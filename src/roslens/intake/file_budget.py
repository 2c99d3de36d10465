"""What the reading of one file may take of the machine, whichever file it is: processor time and memory.

Two bounds one above the other. The inner one raises :class:`OverBudgetError` where Python, a regular expression or the
parser is at work. What that does not reach, such as a query over a syntax tree or the memory of a tree, the kernel
ends (``RLIMIT_CPU``, ``RLIMIT_AS``): then the process is gone, and the one that started it finds in memory that both
share which file was in hand, starts another one and has it leave out that file. So the kernel's bounds are set only
in a process that another one watches (:func:`watch`).
"""

from __future__ import annotations

import contextlib
import mmap
import os
import signal
import sys
import threading
import time
from collections.abc import Iterator, Mapping
from math import ceil

import msgspec

from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError, time_budget

LEAST_MEMORY, MOST_MEMORY = 512_000_000, 2_000_000_000

MORE_S = 2.0
"""Of processor time, for the inner bound to be reported before the kernel ends the process."""

_SMALL_BYTES = 32_768
"""Of files with fewer no shape takes a tenth of what a file may: the kernel is not asked how much is in use."""

_SLOT_BYTES = 4096
_ENDED = frozenset(
    getattr(signal, name) for name in ("SIGXCPU", "SIGKILL", "SIGABRT", "SIGSEGV", "SIGBUS") if hasattr(signal, name)
)


def most_jobs() -> int:
    """Return with how many processes each has :data:`LEAST_MEMORY` of half of the machine; at least 1."""
    return max(1, _half_of_memory() // LEAST_MEMORY)


def memory_of_file(jobs: int = 0) -> int:
    """Return how many bytes the reading of a file may take in each of ``jobs`` processes (0: one for each processor).

    Together they take half of the machine's memory, as far as that leaves each :data:`LEAST_MEMORY`.
    """
    return max(LEAST_MEMORY, min(MOST_MEMORY, _half_of_memory() // (jobs or _shared_by[0] or os.cpu_count() or 1)))


def share_memory(jobs: int) -> None:
    """Have this process take the share of one of ``jobs`` from now on."""
    _shared_by[0] = jobs


_shared_by = [0]


def _half_of_memory() -> int:
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2
    except (AttributeError, OSError, ValueError):
        return MOST_MEMORY


class Slot:
    """Memory that a process shares with the one that watches it: what it has in hand."""

    def __init__(self, number: int = 1, *, shared: bool = False) -> None:
        """Have room for so many processes, which are copies of this one unless it is ``shared`` by a descriptor."""
        self.descriptor: int | None = None
        if shared and sys.platform == "linux":
            self.descriptor = os.memfd_create("roslens")
            os.ftruncate(self.descriptor, number * _SLOT_BYTES)
        self._shared = mmap.mmap(-1 if self.descriptor is None else self.descriptor, number * _SLOT_BYTES)
        self._at = 0

    @classmethod
    def at(cls, descriptor: int) -> Slot:
        """Return the one that another process shares by a descriptor, which is closed."""
        one = object.__new__(cls)
        one.descriptor, one._at = None, 0
        one._shared = mmap.mmap(descriptor, _SLOT_BYTES)
        os.close(descriptor)
        return one

    def close(self) -> None:
        """Close the descriptor, if there is one; what is in hand can still be read."""
        if self.descriptor is not None:
            os.close(self.descriptor)
            self.descriptor = None

    def of(self, number: int) -> Slot:
        """Return the part for one of the processes."""
        one = object.__new__(Slot)
        one.descriptor = None
        one._shared, one._at = self._shared, number * _SLOT_BYTES
        return one

    def put(self, subject: str) -> None:
        """Note what this process has in hand; empty for nothing."""
        name = subject.encode("utf-8", "surrogateescape")[: _SLOT_BYTES - 16]
        head = len(name).to_bytes(4, "big") + os.getpid().to_bytes(8, "big")
        self._shared[self._at : self._at + 12 + len(name)] = head + name

    def get(self) -> tuple[int, str]:
        """Return the number of the process and what it has in hand."""
        head = self._shared[self._at : self._at + 12]
        size = int.from_bytes(head[:4], "big")
        name = self._shared[self._at + 12 : self._at + 12 + size]
        return int.from_bytes(head[4:], "big"), name.decode("utf-8", "surrogateescape")


class Refused(msgspec.Struct, frozen=True):
    """A file that was left out, and why."""

    subject: str
    why: str


class _InHand(msgspec.Struct):
    subject: str
    cpu_end: float


_slot: list[Slot] = []
_in_hand: list[_InHand] = []
_refused: dict[str, str] = {}


def watch(slot: Slot) -> None:
    """Have the kernel bound what is read from now on; whoever shares the slot sees what is in hand."""
    _slot[:] = [slot]
    _in_hand.clear()
    slot.put("")


def is_watched() -> bool:
    """Return whether the kernel bounds what is read here: in the main thread of a process that another one watches."""
    return bool(_slot) and threading.current_thread() is threading.main_thread()


def unwatch() -> None:
    """Have only the inner bounds again."""
    _slot.clear()


def refuse(subjects: Mapping[str, str]) -> None:
    """Leave out files from now on, each with the reason."""
    _refused.update(subjects)


def refuse_only(subjects: Mapping[str, str]) -> None:
    """Leave out these files and no others from now on, each with the reason."""
    _refused.clear()
    _refused.update(subjects)


def refused() -> Mapping[str, str]:
    """Return what this process leaves out, with the reasons."""
    return _refused


def begin_reading() -> None:
    """Leave out nothing of what this process found by itself, for files may have changed meanwhile."""
    if not _slot:
        _refused.clear()


def why_ended(code: int) -> str:
    """Return why a process whose exit code is that of a signal exceeded a bound; empty where it did not."""
    if -code == getattr(signal, "SIGXCPU", 0):
        return f"it takes more than {SOURCE_FILE_S:g} s of processor time"
    if -code in _ENDED:
        return f"it needs more than {memory_of_file() / 1e6:,.0f} MB of memory, or breaks the parser"
    return ""


@contextlib.contextmanager
def file_budget(subject: str, *, size: int = _SMALL_BYTES, seconds: float = SOURCE_FILE_S) -> Iterator[None]:
    """Let what is done inside take what one file may.

    A file that is read while another one is, such as an include, has a budget of its own.

    Args:
        subject: path of the file, as failures name it.
        size: of it in bytes.
        seconds: of processor time.

    Raises:
        OverBudgetError: it takes more, or did so before; from then on the file is left out.
    """
    if why := _refused.get(subject):
        raise OverBudgetError(why, subject)
    with _bounded(subject, size, seconds):
        try:
            with time_budget(seconds):
                yield
        except OverBudgetError as error:
            error.subject = error.subject or subject
            _refused[error.subject] = str(error)
            raise
        except MemoryError:
            why = f"it needs more than {memory_of_file() / 1e6:,.0f} MB of memory"
            _refused[subject] = why
            raise OverBudgetError(why, subject) from None


@contextlib.contextmanager
def _bounded(subject: str, size: int, seconds: float) -> Iterator[None]:
    if not is_watched():
        yield
        return
    slot = _slot[0]
    now = time.process_time()
    outer = _in_hand[-1] if _in_hand else None
    memory = outer is None and size >= _SMALL_BYTES
    one = _InHand(subject, now + seconds + MORE_S)
    _in_hand.append(one)
    slot.put(subject)
    _limit_processor(one.cpu_end)
    if memory:
        _limit_memory()
    try:
        yield
    finally:
        if memory:
            _free_memory()
        _in_hand.pop()
        if outer is None:
            _limit_processor(0.0)
            slot.put("")
        else:
            outer.cpu_end += time.process_time() - now
            _limit_processor(outer.cpu_end)
            slot.put(outer.subject)


def _limit_processor(end_s: float) -> None:
    """Have the kernel end this process at so many seconds of processor time; 0 for never. It counts whole ones."""
    if sys.platform != "linux":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_CPU)
    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_CPU, (max(1, ceil(end_s)) if end_s else hard, hard))


def _limit_memory() -> None:
    if sys.platform != "linux":
        return
    import resource

    with contextlib.suppress(OSError, ValueError, IndexError):
        opened = os.open("/proc/self/statm", os.O_RDONLY | os.O_CLOEXEC)
        try:
            pages = int(os.read(opened, 64).split()[0])
        finally:
            os.close(opened)
        most = pages * mmap.PAGESIZE + memory_of_file()
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        if hard == resource.RLIM_INFINITY or most < hard:
            resource.setrlimit(resource.RLIMIT_AS, (most, hard))


def _free_memory() -> None:
    if sys.platform != "linux":
        return
    import resource

    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
