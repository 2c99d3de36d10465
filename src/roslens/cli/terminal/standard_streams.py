"""Standard streams that are closed, full, gone or of a narrow encoding: said in an exit code, never by a traceback."""

from __future__ import annotations

import codecs
import contextlib
import io
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from functools import cached_property
from typing import BinaryIO, cast

from roslens.report.writing.control_characters import shown_controls

CUT_OFF = 141
"""The reader of standard output closed it before its end; shells use this code for a program ended by SIGPIPE."""

NOT_WRITTEN = 74
"""Standard output could not be written (EX_IOERR)."""

_ESCAPED = "roslens_escaped"


def open_streams() -> None:
    """See that all three streams are there, and that no text fails to be written for the letters in it.

    A stream that is closed would be taken by the next file that is opened, and what is printed would go there. What is
    read from one is empty, what is written to standard error is dropped, and to standard output an error.
    """
    for number, how in ((0, os.O_RDONLY), (1, os.O_RDONLY), (2, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            opened = os.open(os.devnull, how)
            if opened != number:
                os.dup2(opened, number)
                os.close(opened)
    sys.stdin = sys.stdin or open(0, encoding="utf-8", closefd=False)  # noqa: SIM115 - as long as the process
    sys.stdout = sys.stdout or open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    codecs.register_error(_ESCAPED, escaped)
    before = sys.stdout
    before.flush()
    if isinstance(before, io.TextIOWrapper):
        encoding, by_line = before.encoding, before.line_buffering
        written = Output(before.detach(), encoding=encoding, errors=_ESCAPED, line_buffering=by_line)
        sys.stdout = sys.__stdout__ = written  # type: ignore[misc]
    errors = os.fdopen(2, "wb", closefd=False)
    sys.stderr = Errors(errors, encoding=sys.stderr.encoding, errors=_ESCAPED, line_buffering=True)


class Errors(io.TextIOWrapper):
    """Standard error that writes control characters out, but for those by which a terminal shows progress."""

    @cached_property
    def _colours(self) -> bool:
        return self.isatty()

    def write(self, text: str, /) -> int:
        """Write text."""
        return super().write(shown_controls(text, colours=self._colours))


class Output(io.TextIOWrapper):
    """Standard output that writes control characters out, but for those that colour a terminal.

    It remembers that it could not be written, also where whoever wrote did not look.
    """

    failure: OSError | None = None

    @cached_property
    def _colours(self) -> bool:
        return self.isatty()

    @property
    def buffer(self) -> BinaryIO:
        """What bytes are written to directly; a failure there is remembered here."""
        return cast("BinaryIO", _Bytes(cast("BinaryIO", super().buffer), self._noticing))

    def write(self, text: str, /) -> int:
        """Write text."""
        with self._noticing():
            return super().write(shown_controls(text, colours=self._colours))

    def flush(self) -> None:
        """Hand on what was written."""
        with self._noticing():
            super().flush()

    @contextlib.contextmanager
    def _noticing(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            self.failure = error
            raise


class _Bytes:
    """The bytes below standard output."""

    def __init__(self, below: BinaryIO, noticing: Callable[[], AbstractContextManager[None]]) -> None:
        self._below = below
        self._noticing = noticing

    def write(self, data: bytes) -> int:
        with self._noticing():
            return self._below.write(data)

    def writelines(self, lines: Iterable[bytes]) -> None:
        with self._noticing():
            self._below.writelines(lines)

    def flush(self) -> None:
        with self._noticing():
            self._below.flush()


def close_output(code: int) -> int:
    """Write what is left of standard output; return ``code``, or the code for output that could not be written."""
    with contextlib.suppress(OSError, ValueError):
        sys.stdout.flush()
    return output_failed() or code


def output_failed() -> int:
    """Return the exit code where standard output could not be written, and drop what is left of it; else 0."""
    failure = sys.stdout.failure if isinstance(sys.stdout, Output) else None
    if failure is None:
        return 0
    _drop_output()
    if isinstance(failure, BrokenPipeError):
        return CUT_OFF
    say(f"roslens: standard output could not be written: {failure.strerror}. Write to a file with -o")
    return NOT_WRITTEN


def say(text: str) -> None:
    """Print a message to standard error, if it can be written."""
    with contextlib.suppress(OSError, ValueError):
        print(text, file=sys.stderr, flush=True)


def _drop_output() -> None:
    """Let what is left go nowhere: the interpreter would try again at its end, and say so."""
    if isinstance(sys.stdout, Output):
        sys.stdout.failure = None
    with contextlib.suppress(OSError, ValueError):
        nothing = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nothing, sys.stdout.fileno())
        os.close(nothing)


def escaped(error: UnicodeError) -> tuple[str, int]:
    """Write letters that the encoding lacks as JSON does: in pairs of sixteen bits."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    units = error.object[error.start : error.end].encode("utf-16-be", "surrogatepass")
    pairs = (units[at : at + 2] for at in range(0, len(units), 2))
    return "".join(f"\\u{int.from_bytes(pair, 'big'):04x}" for pair in pairs), error.end
