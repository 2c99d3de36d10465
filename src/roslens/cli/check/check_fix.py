"""What ``roslens check`` does about fixes: shows them, makes them, takes them back."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED

if TYPE_CHECKING:
    from roslens.cli.check.check_scope import Scope
    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.failure import Failure
    from roslens.source.fix.mended_files import MendedFile

MOST_ROUNDS = 10
"""Times that files are written and looked at again: what a tool mends it sees only where the file is written."""


def show_diff(options: argparse.Namespace, root: Path, configuration: Configuration, scope: Scope) -> int:
    """Write what would be fixed as a diff; return the exit code.

    Raises:
        RoslensError: the workspace cannot be looked at.
        OSError: standard output cannot be written.
    """
    from roslens.cli.check.fixing import mended_scope, summary

    result = mended_scope(options, root, configuration, scope)
    write_diff(result.files, root)
    tell(options, summary([result], would=True), result.failures)
    if result.failures:
        return NOT_ANALYSED
    return FINDINGS if result.files else CLEAN


def write_diff(files: Sequence[MendedFile], root: Path) -> None:
    """Write changes to standard output; paths are below the current folder where the workspace is, else below it."""
    from roslens.report.run.to_diff import to_diff

    here = Path.cwd().resolve()
    below = f"{root.relative_to(here).as_posix()}/" if root != here and root.is_relative_to(here) else ""
    sys.stdout.flush()
    for file in files:
        sys.stdout.buffer.writelines(to_diff(f"{below}{file.path}", file.before, file.after))
    sys.stdout.buffer.flush()


def fixed_scope(
    options: argparse.Namespace, root: Path, configuration: Configuration, scope: Scope, look: Callable[[], Scope]
) -> Scope:
    """Fix what is shown, and return what the workspace is like afterwards, with what could not be fixed.

    Raises:
        RoslensError: the workspace cannot be looked at, or the way back cannot be kept.
    """
    from roslens.cli.check.fixing import mended_scope, summary, written
    from roslens.store.narrowed import with_failures

    results = []
    record = None
    for _ in range(MOST_ROUNDS):
        result = mended_scope(options, root, configuration, scope)
        result, record = written(result, root, keep=not options.no_store, earlier=record)
        results.append(result)
        if not result.files:
            break
        scope = look()
        if result.failures:
            break
    if options.each:
        options.each = False
        scope = look()
    failures = tuple(dict.fromkeys(failure for result in results for failure in result.failures))
    tell(options, summary(results), ())
    if any(result.files for result in results) and not options.quiet:
        back = "" if options.no_store else "; `roslens check --undo-fix` takes it back"
        print(f"roslens: `git diff` shows what changed{back}", file=sys.stderr)
    if not failures:
        return scope
    shown, judged = with_failures(scope.shown, failures), with_failures(scope.judged, failures)
    return msgspec.structs.replace(scope, shown=shown, judged=judged)


def take_back(options: argparse.Namespace, root: Path) -> int:
    """Take the last fix back; return the exit code.

    Raises:
        UsageError: there is none.
    """
    from roslens.cli.check.fixing import undo

    done, failures = undo(root)
    tell(options, f"{len(done)} file{'s' * (len(done) != 1)} as before the last fix", failures)
    return NOT_ANALYSED if failures else CLEAN


def tell(options: argparse.Namespace, text: str, failures: Sequence[Failure]) -> None:
    """Report on standard error what was done; what could not be done is reported even with ``--quiet``."""
    from roslens.report.writing.terminal import printable

    if not options.quiet:
        print(f"roslens: {text}", file=sys.stderr)
    for failure in failures:
        print(printable(f"roslens: {failure}"), file=sys.stderr)
