"""What goes to the terminal: progress and messages to standard error, results to standard output."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import time
from pathlib import Path
from typing import TextIO

from roslens.report.writing.control_characters import shown_controls


def add_stream_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``-q``, ``-v`` and ``--no-color``."""
    parser.add_argument("-q", "--quiet", action="store_true", help="print no progress and no hints")
    parser.add_argument("-v", "--verbose", action="store_true", help="name each package when it is done; show details")
    parser.add_argument("--no-color", action="store_true", help="print no colours (as does NO_COLOR)")


def wants_color(options: argparse.Namespace, stream: TextIO) -> bool:
    """Return whether ``stream`` is a terminal and plain text was not requested."""
    if options.no_color or os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        return False
    return stream.isatty()


def width_of(stream: TextIO) -> int:
    """Return the columns of the terminal; 100 where there is none."""
    return shutil.get_terminal_size((100, 24)).columns if stream.isatty() else 100


def write_result(text: str, output: str | None) -> None:
    """Write a result to a file, whole or not at all, or to standard output."""
    if output is None:
        sys.stdout.write(text)
        return
    from roslens.report.writing.whole_file import whole_file

    with whole_file(Path(output)) as stream:
        stream.write(text)


class TerminalProgress:
    """One line that is written over, on a terminal."""

    def __init__(self, stream: TextIO) -> None:
        """Write to ``stream``."""
        self._stream = stream
        self._title = ""
        self._total = 0
        self._done = 0
        self._last = 0.0

    def step(self, title: str, total: int) -> None:
        """Begin a step of ``total`` items (0: unknown)."""
        self._title, self._total, self._done = title, total, 0
        self._show("", force=True)

    def advance(self, count: int = 1, item: str = "") -> None:
        """Report that ``count`` more items are done, the last of them ``item``."""
        self._done += count
        self._show(item)

    def finish(self) -> None:
        """Take the line away."""
        self._stream.write("\r\x1b[K")
        self._stream.flush()

    def _show(self, item: str, *, force: bool = False) -> None:
        now = time.monotonic()
        if not force and now - self._last < 0.1 and self._done < self._total:
            return
        self._last = now
        count = f" {self._done}/{self._total}" if self._total else "…"
        text = shown_controls(f"{self._title}{count} {item}")[: width_of(self._stream) - 1]
        self._stream.write(f"\r\x1b[K{text}")
        self._stream.flush()


class LineProgress:
    """Plain lines, for logs: one per step, and one every so often in between."""

    def __init__(self, stream: TextIO, *, verbose: bool = False, every_s: float = 10.0) -> None:
        """Write to ``stream``: each item if ``verbose``, else a line every ``every_s`` seconds."""
        self._stream = stream
        self._verbose = verbose
        self._every_s = every_s
        self._title = ""
        self._total = 0
        self._done = 0
        self._last = time.monotonic()

    def step(self, title: str, total: int) -> None:
        """Begin a step of ``total`` items (0: unknown)."""
        self._title, self._total, self._done = title, total, 0
        if total:
            print(f"{title}: {total}", file=self._stream, flush=True)

    def advance(self, count: int = 1, item: str = "") -> None:
        """Report that ``count`` more items are done, the last of them ``item``."""
        self._done += count
        now = time.monotonic()
        if self._verbose or now - self._last >= self._every_s:
            self._last = now
            of_all = f"/{self._total}" if self._total else ""
            print(f"{self._title}: {self._done}{of_all} {item}".rstrip(), file=self._stream, flush=True)

    def finish(self) -> None:
        """Nothing is left on the line."""


class NoProgress:
    """Progress is not requested."""

    def step(self, title: str, total: int) -> None:
        """Do nothing."""

    def advance(self, count: int = 1, item: str = "") -> None:
        """Do nothing."""

    def finish(self) -> None:
        """Do nothing."""


def progress_for(options: argparse.Namespace) -> TerminalProgress | LineProgress | NoProgress:
    """Return what shows progress on standard error, as the options and the terminal want it."""
    if options.quiet:
        return NoProgress()
    if sys.stderr.isatty() and not options.verbose:
        return TerminalProgress(sys.stderr)
    return LineProgress(sys.stderr, verbose=options.verbose)
