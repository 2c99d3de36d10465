"""What happens at the edge: every way a command can end becomes an exit code and a message.

==== =========================================================================================
0    clean
1    findings at or above ``--fail-on``
2    usage or bad input
3    something could not be analysed (the report says what)
74   standard output could not be written
141  whoever read standard output went away before its end
70   a bug; a file with everything needed to report it has been written
130  interrupted: by Ctrl-C, a request to end (SIGTERM) or a terminal that closed (SIGHUP)
==== =========================================================================================
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NoReturn

from roslens.children.scratch_folder import sweep_scratch
from roslens.cli.terminal.standard_streams import CUT_OFF, output_failed, say
from roslens.model.errors import RoslensError
from roslens.store.file_size_limit import process_limit
from roslens.store.full_disk import full_file_system

CLEAN = 0
FINDINGS = 1
BAD_INPUT = 2
NOT_ANALYSED = 3
BUG = 70
INTERRUPTED = 130

_ENDING = (signal.SIGINT, signal.SIGTERM, *((signal.SIGHUP,) if hasattr(signal, "SIGHUP") else ()))


def guarded(command: Callable[[], int], arguments: Sequence[str]) -> int:
    """Run ``command`` and return the exit code; messages go to standard error."""
    try:
        with _ended_by_signals():
            sweep_scratch()
            code = command()
            sys.stdout.flush()
        return code
    except RoslensError as error:
        say(f"roslens: {error}")
        return BAD_INPUT
    except KeyboardInterrupt:
        say("roslens: interrupted; the last complete run is untouched")
        return INTERRUPTED
    except OSError as error:
        if failed := output_failed():
            return failed
        if isinstance(error, BrokenPipeError):
            return CUT_OFF
        say(f"roslens: {_of_system(error)}")
        return BAD_INPUT
    except Exception as error:  # noqa: BLE001 - the last line of defence: a bug becomes a report
        return _report_bug(error, arguments)


_ASKED = getattr(signal, "SIGUSR2", signal.SIGTERM)
_is_watched: list[bool] = []


def be_asked() -> None:
    """Have this process be ended by the one that watches it alone: a terminal sends its interrupts to both.

    Programs that it starts are ended by signals as ever: handlers are not handed on to them.
    """
    _is_watched[:] = [True]
    for number in _ENDING:
        signal.signal(number, _leave)


def ask_to_end(pid: int) -> None:
    """Ask a process to end that is watched."""
    with suppress(ProcessLookupError):
        os.kill(pid, _ASKED)


def _leave(_number: int, _frame: object) -> None:
    """Leave a signal to the process that watches this one."""


@contextmanager
def _ended_by_signals() -> Iterator[None]:
    """Be interrupted by a request to end and by a terminal that closes as by Ctrl-C, so that what is begun is undone.

    Once it is over, an interrupt ends the process at once: there is nothing left to undo, and no traceback to show.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    if _is_watched:
        signal.signal(_ASKED, _interrupt_again)
        try:
            yield
        finally:
            signal.signal(_ASKED, signal.SIG_DFL)
        return
    before = {number: signal.getsignal(number) for number in _ENDING}
    signal.signal(signal.SIGINT, signal.default_int_handler)
    for number in _ENDING[1:]:
        if before[number] is signal.SIG_DFL:
            signal.signal(number, _interrupt)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _interrupt(number: int, _frame: object) -> NoReturn:
    signal.signal(number, signal.SIG_IGN)
    raise KeyboardInterrupt


def _interrupt_again(_number: int, _frame: object) -> NoReturn:
    raise KeyboardInterrupt


def _of_system(error: OSError) -> str:
    import errno

    where = f"{error.filename}: " if error.filename else ""
    if error.errno in (errno.ENOSPC, errno.EDQUOT):
        full = full_file_system(filter(None, (error.filename, Path.cwd())))
        what = f"the file system is full: {full}" if full else error.strerror
        return f"{where}{what}. Free some space there, or write elsewhere with -o, or use --no-store --no-cache."
    if error.errno == errno.EFBIG and (most := process_limit()):
        return f"{where}a file may have at most {most:,} bytes here. Raise the limit (`ulimit -f`), or write elsewhere."
    advice = {
        errno.EACCES: "Check the permissions, or write elsewhere with -o",
        errno.EROFS: "The file system is read-only: use --no-store --no-cache, or write elsewhere with -o",
    }.get(error.errno or 0, "Check the path and try again")
    return f"{where}{error.strerror or error}. {advice}."


def _report_bug(error: Exception, arguments: Sequence[str]) -> int:
    import platform
    import tempfile
    import traceback

    from roslens import __version__

    text = "\n".join(
        (
            f"roslens {__version__}, Python {platform.python_version()}, {platform.platform()}",
            f"arguments: {list(arguments)!r}",
            "",
            "".join(traceback.format_exception(error)),
        )
    )
    say(f"roslens: a bug: {type(error).__name__}: {error}")
    try:
        handle, name = tempfile.mkstemp(prefix="roslens-bug-", suffix=".txt")
        with os.fdopen(handle, "w", encoding="utf-8", errors="replace") as file:
            file.write(text)
        say(f"roslens: please attach {Path(name)} to a report of it")
    except OSError:
        say(text)
    return BUG
