"""``roslens history``: what ``roslens watch --history`` kept; with ``--every``, past revisions of source."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.past.revision_history import add_revision_arguments, analyse_past
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.report.history.history_rows import Extract
    from roslens.report.writing.csv_table import Table

TEXT = (
    "Show or export what `roslens watch --history` kept of a running system; or, with --every, analyse past revisions "
    "of source."
)
EXAMPLES = """\
  roslens history --every release                          each release of the repository that this folder is in
  roslens history ~/robot_ws/src/nav --every month --since 2022-01-01
  roslens history robot.sqlite                             every series as a line, then what was wrong
  roslens history robot.sqlite --entity 'topic:/camera/**' --signal rate --since 10min
  roslens history robot.sqlite --format csv -o series.csv
  roslens history robot.sqlite --what verdicts --format csv --since 2026-01-31T08:00 --until 2026-01-31T09:00
  roslens history day1.sqlite day2.sqlite --format parquet -o series.parquet"""

PARTS = ("series", "verdicts", "events")
_STRETCH = "a time before the end such as `10min`, after the beginning such as `+30s`, or one such as 2026-01-31T08:00"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add files, what of them is wanted, and how it is written; and what there is of past revisions."""
    parser.add_argument(
        "files", nargs="*", type=Path, metavar="FILE",
        help="that `roslens watch --history` wrote; with --every, the folder of a workspace",
    )  # fmt: skip
    add_revision_arguments(parser)
    group = parser.add_argument_group("history of a running system")
    parser.add_argument("--since", metavar="TIME", help=f"{_STRETCH}; with --every, a date or a revision")
    _add_live_arguments(group)
    parser.add_argument("--no-color", action="store_true", help="print no colours (as does NO_COLOR)")


def _add_live_arguments(parser: argparse._ArgumentGroup) -> None:
    parser.add_argument(
        "--entity", action="append", default=[], metavar="PATTERN",
        help="only entities that match, with or without a kind, as in references: 'topic:/camera/**', '/lidar'",
    )  # fmt: skip
    parser.add_argument(
        "--signal", action="append", default=[], metavar="PATTERN", help="only these signals: rate, 'cpu*'"
    )
    parser.add_argument("--until", metavar="TIME", help="the same")
    parser.add_argument(
        "--what", action="append", default=[], choices=PARTS, help="only this (default: all; CSV and Parquet: series)"
    )
    parser.add_argument("--format", choices=("text", "json", "csv", "parquet"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")


def run(options: argparse.Namespace) -> int:
    """Read the files and write what was asked for.

    Raises:
        UsageError: an option makes no sense, or nothing that was kept matches.
        StoreError: a file is no history.
    """
    from roslens.live.window.signals import BY_KEY

    if options.every is not None:
        return analyse_past(options, _workspace(options))
    _refuse_past(options)
    parts = frozenset(options.what) or frozenset(PARTS if options.format in ("text", "json") else PARTS[:1])
    if options.format in ("csv", "parquet") and len(parts) > 1:
        raise UsageError(f"--format {options.format} with {len(parts)} times --what", expected="one table a file")
    if options.format == "parquet" and options.output is None:
        raise UsageError("--format parquet without --output", expected="-o FILE")
    of_entity, of_signal = _entities(options.entity), _signals(options.signal)
    extracts = [_extract(path, options, parts, of_entity, of_signal) for path in options.files]
    if (options.entity or options.signal) and not any(one.series or one.verdicts or one.events for one in extracts):
        words = " ".join(
            [*(f"--entity {one!r}" for one in options.entity), *(f"--signal {one!r}" for one in options.signal)]
        )
        raise UsageError(
            f"{words} matches nothing that was kept", expected="a pattern of what the file holds",
            advice="See it all: roslens history FILE",
        )  # fmt: skip
    units = {key: quantity.unit for key, quantity in BY_KEY.items()}
    _write(options, extracts, parts, units)
    return 0


def _workspace(options: argparse.Namespace) -> Path:
    """Return the folder whose past revisions are meant.

    Raises:
        UsageError: there are several, it is a file, or an option of the other meaning is given.
    """
    live = [f"--{name}" for name in ("entity", "signal", "until", "what") if getattr(options, name)]
    if live or options.format != "text" or options.output is not None:
        named = (live or ["--format" if options.format != "text" else "--output"])[0]
        raise UsageError(
            f"{named} with --every", expected=f"{named} for the history of a running system: roslens history FILE",
            advice="See what was kept of past revisions: roslens trend loc --format csv",
        )  # fmt: skip
    if len(options.files) > 1:
        raise UsageError(f"--every with {len(options.files)} folders", expected="one folder")
    folder = Path(*options.files)
    if not folder.is_dir():
        raise UsageError(f'--every with "{folder}"', expected="the folder of a workspace")
    return folder.resolve()


def _refuse_past(options: argparse.Namespace) -> None:
    """Refuse what only past revisions have.

    Raises:
        UsageError: it was given, or no file was.
    """
    for name in ("model", "config"):
        if getattr(options, name):
            raise UsageError(f"--{name} without --every", expected=f"--every release --{name} ...")
    if not options.files:
        raise UsageError(
            "neither a FILE nor --every",
            expected="what `roslens watch --history FILE` wrote, or --every release|month|N",
            advice="`roslens history --help` has examples of both",
        )  # fmt: skip
    for folder in filter(Path.is_dir, options.files):
        raise UsageError(
            f'"{folder}" is a folder', expected="a file that `roslens watch --history` wrote",
            advice=f"Analyse its past revisions: roslens history {folder} --every release",
        )  # fmt: skip


def _extract(
    path: Path, options: argparse.Namespace, parts: frozenset[str], of_entity: Callable[[str], bool],
    of_signal: Callable[[str], bool],
) -> Extract:  # fmt: skip
    from roslens.report.history.history_rows import Extract
    from roslens.store.live.read_history import read_history

    def wanted(entity: str, signal: str) -> bool:
        return of_entity(entity) and of_signal(signal)

    with read_history(path) as history:
        begin, end = history.stretch() or (0.0, 0.0)
        since = time_of(options.since, "--since", begin, end) if options.since is not None else begin
        until = time_of(options.until, "--until", begin, end) if options.until is not None else end
        if until < since:
            raise UsageError(
                f"--until {options.until or end} before --since {options.since}", expected="a stretch of time"
            )
        return Extract(
            path, begin, since, until,
            tuple(history.series(since, until, wanted)) if "series" in parts else (),
            tuple(history.verdicts(since, until, wanted)) if "verdicts" in parts else (),
            tuple(history.events(since, until, of_entity)) if "events" in parts and not options.signal else (),
        )  # fmt: skip


def time_of(text: str, option: str, begin: float, end: float) -> float:
    """Return the seconds since the epoch that an option means, of a history from ``begin`` to ``end``.

    Raises:
        UsageError: it is no time.
    """
    from datetime import datetime

    from roslens.judge.ranges.amount import parse_amount

    try:
        length = parse_amount(text.removeprefix("+"), "s")
    except ValueError:
        try:
            return datetime.fromisoformat(text).astimezone().timestamp()
        except ValueError:
            raise UsageError(f"{option} {text!r}", expected=_STRETCH) from None
    return begin + length if text.startswith("+") else end - length


def _entities(patterns: Sequence[str]) -> Callable[[str], bool]:
    """Return whether the text form of an entity id is wanted."""
    from roslens.judge.patterns.pattern import Pattern
    from roslens.model.entity import EntityKind

    kinds = {kind.value for kind in EntityKind}
    read = []
    for text in patterns:
        kind, colon, name = text.partition(":")
        known = bool(colon) and kind in kinds
        try:
            read.append((kind if known else "", Pattern.parse(name if known else text)))
        except ValueError as error:
            raise UsageError(f"--entity {text!r}: {error}", expected="a pattern such as 'topic:/camera/**'") from None

    def wanted(entity: str) -> bool:
        of, _, called = entity.partition(":")
        return not read or any((not kind or kind == of) and pattern.matches(called) for kind, pattern in read)

    return wanted


def _signals(patterns: Sequence[str]) -> Callable[[str], bool]:
    from fnmatch import fnmatchcase

    return lambda signal: not patterns or any(fnmatchcase(signal, pattern) for pattern in patterns)


def _write(options: argparse.Namespace, extracts: list[Extract], parts: frozenset[str], units: dict[str, str]) -> None:
    from roslens.cli.terminal.streams import wants_color, width_of, write_result

    if options.format == "json":
        from roslens.report.history.history_document import history_json

        write_result(history_json(extracts, units), options.output)
    elif options.format == "csv":
        from io import StringIO

        from roslens.report.writing.csv_table import write_rows

        stream = StringIO(newline="")
        write_rows(_table(next(iter(parts)), extracts, units), stream)
        write_result(stream.getvalue(), options.output)
    elif options.format == "parquet":
        from roslens.report.writing.to_parquet import write_parquet

        write_parquet(_table(next(iter(parts)), extracts, units), Path(options.output))
    else:
        from roslens.report.history.history_text import history_text
        from roslens.report.writing.terminal import Terminal

        plain = options.output is not None
        unicode = plain or (sys.stdout.encoding or "").lower().replace("-", "").startswith("utf")
        terminal = Terminal(
            100 if plain else width_of(sys.stdout), not plain and wants_color(options, sys.stdout), unicode
        )
        write_result(history_text(extracts, units, terminal, _amount), options.output)


def _amount(value: float, unit: str) -> str:
    """Return a value in four digits, which is what a summary is read for."""
    from roslens.judge.ranges.amount import amount_text

    return amount_text(float(f"{value:.4g}"), unit)


def _table(part: str, extracts: list[Extract], units: dict[str, str]) -> Table:
    from roslens.report.history.history_rows import events_table, series_table, verdicts_table

    if part == "series":
        return series_table(extracts, units)
    return verdicts_table(extracts) if part == "verdicts" else events_table(extracts)
