"""Which formats ``roslens check`` writes, and where each of them goes."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from roslens.cli.terminal.streams import wants_color, width_of
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.model.result import RuleCount
    from roslens.report.run.finding_text import Whole
    from roslens.report.run.reported import Wanted
    from roslens.store.read import RunView

Output = tuple[str, str]
"""Name of a format and the file that it is written to, empty for standard output."""


def add_output_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--format`` and ``-o``."""
    parser.add_argument(
        "--format",
        action="append",
        metavar="NAME[=FILE]",
        help="output format: text (default), json, csv, sarif, junit, gitlab, github, checkstyle, markdown or badge; "
        "with =FILE it is written there besides; may be given again",
    )
    parser.add_argument(
        "-o",
        "--output",
        action="append",
        metavar="FILE",
        help="write the result to this file instead, in the format of --format or of the ending (.json, .sarif, "
        ".junit.xml, .md, .svg…); a csv name without .csv is a folder for all tables; may be given again",
    )


def outputs(formats: Sequence[str], files: Sequence[str]) -> tuple[Output, ...]:
    """Return what is written where.

    Args:
        formats: values of ``--format``, each ``NAME`` or ``NAME=FILE``.
        files: values of ``-o``.

    Raises:
        UsageError: a format is unknown, or it is not clear which goes where.
    """
    from roslens.report.run.formats import FORMATS

    beside: list[Output] = []
    plain: list[str] = []
    for given in formats:
        name, separator, file = given.partition("=")
        if name not in FORMATS:
            raise _unknown(name, FORMATS)
        if separator and not file:
            raise UsageError(f'--format "{given}" names no file', expected=f"{name}=FILE or {name}")
        if separator:
            beside.append((name, file))
        else:
            plain.append(name)
    if len(plain) > 1:
        raise UsageError(
            f"--format {' --format '.join(plain)}: only one goes to standard output or to -o",
            expected="NAME=FILE for the others",
        )
    chosen = (*_instead(plain, files), *beside)
    targets = [str(Path(file).absolute()) for _, file in chosen if file]
    if twice := next((file for file in targets if targets.count(file) > 1), None):
        raise UsageError(f'"{twice}" is given for two results', expected="a file of its own for each")
    return chosen


def _instead(plain: Sequence[str], files: Sequence[str]) -> tuple[Output, ...]:
    """Return what is shown on standard output, or in the files given instead."""
    if not files:
        return ((plain[0] if plain else "text", ""),)
    if plain and len(files) > 1:
        raise UsageError(
            f"--format {plain[0]} with {len(files)} -o",
            expected=f"--format {plain[0]}=FILE for one of them; the extensions of the others determine their format",
        )
    return tuple((plain[0] if plain else _by_ending(file), file) for file in files)


def _by_ending(file: str) -> str:
    from roslens.report.run.formats import ENDINGS, format_of

    found = format_of(file)
    if found is not None:
        return found
    if file.lower().endswith((".html", ".htm")):
        raise UsageError(
            f'-o "{file}": roslens check writes no pages', advice=f"Run `roslens report --single-file {file}` after it"
        )
    if file.lower().endswith(".xml"):
        expected = f"--format junit={file} or --format checkstyle={file}"
    else:
        expected = f"one of {', '.join(filter(None, ENDINGS))}, or --format NAME={file}"
    raise UsageError(f'-o "{file}": its extension does not determine a format', expected=expected)


def _unknown(name: str, known: Sequence[str] | dict[str, str]) -> UsageError:
    from difflib import get_close_matches

    near = get_close_matches(name, list(known), 1)
    return UsageError(
        f'--format "{name}" is unknown',
        expected=f"one of {', '.join(known)}",
        advice=f"Did you mean {near[0]}?" if near else "",
    )


def write_outputs(chosen: Sequence[Output], options: argparse.Namespace, view: RunView, wanted: Wanted) -> None:
    """Write the run in each format to its place; no file is left half written.

    Raises:
        StoreError: the store cannot be read.
        OSError: a file cannot be written.
    """
    for name, file in chosen:
        if not file:
            _write_to(name, options, view, wanted, sys.stdout)
        elif name == "csv" and not file.endswith(".csv"):
            from roslens.report.run.to_csv import write_folder

            write_folder(view, Path(file), wanted.tags)
        else:
            from roslens.report.writing.whole_file import whole_file

            with whole_file(Path(file)) as stream:
                _write_to(name, options, view, wanted, stream)


def _write_to(name: str, options: argparse.Namespace, view: RunView, wanted: Wanted, stream: TextIO) -> None:
    if name != "text":
        from roslens.report.run.formats import write_format

        write_format(name, view, stream, wanted)
        return
    from roslens.report.run.to_text import to_text

    stream.write(
        to_text(
            view.header,
            view.packages(),
            view.failures(),
            view.rules(),
            findings=view.workspace.findings,
            set_aside=Counter(one.state.value for one in view.set_aside(tags=wanted.tags)),
            since=tuple(_since(view, wanted)),
            new=new_first(view, wanted),
            whole=_whole(view, wanted, revision=getattr(options, "changed", None) or ""),
            tags=wanted.tags,
            changes=wanted.changes,
            revision=getattr(options, "changed", None) or "",
            width=width_of(stream),
            color=wants_color(options, stream),
            unicode=(stream.encoding or "").lower().replace("-", "") == "utf8",
        )
    )


def _whole(view: RunView, wanted: Wanted, *, revision: str) -> Whole:
    """Return the findings that are printed one by one: grave ones, and new ones unless they are many."""
    from roslens.report.run.finding_text import MOST_NEW, Whole
    from roslens.report.run.grave_findings import grave_findings

    grave = grave_findings(view, wanted.tags)
    if wanted.new is None and not revision:
        return Whole(grave)
    every = [one for one in view.findings(tags=wanted.tags) if one.gated]
    new = every if wanted.new is None else [one for one in every if wanted.is_new(one)]
    if len(new) > MOST_NEW:
        return Whole(grave)
    return Whole(grave, new, alone=len(new) == len(every))


def new_first(view: RunView, wanted: Wanted) -> tuple[RuleCount, ...]:
    """Return what to mend first of what is new since a baseline."""
    from roslens.report.run.fix_first import first_to_fix
    from roslens.report.run.grave_findings import grave_findings
    from roslens.store.narrowed import NarrowedView

    if wanted.new is None:
        return ()
    new = NarrowedView(view, wanted.is_new)
    rules = {one.id: one for one in view.rules()}
    return first_to_fix(
        new.packages(), new.workspace.findings, rules, wanted.tags, wanted.changes, grave_findings(new, wanted.tags)
    )


def _since(view: RunView, wanted: Wanted) -> Iterator[str]:
    states = {True: "holds", False: "is broken", None: "cannot be determined"}
    yield from (f"Gate {states[one.holds]}: {one.text}" for one in wanted.gate)
    if wanted.new is None:
        return
    found = Counter(one.severity.value for one in view.findings(tags=wanted.tags) if one.gated and wanted.is_new(one))
    parts = ", ".join(
        f"{found[name]:,} {name}{'s' * (found[name] != 1)}" for name in ("error", "warning", "note") if found[name]
    )
    yield f"New since {wanted.baseline}: {parts or 'nothing'}; gone: {wanted.gone:,}"


def below_repository(root: Path) -> str:
    """Return the folder of a workspace below that of the repository around it, empty or with ``/`` at its end.

    It is empty too where the workspace is in no repository; nothing but folders is looked at.
    """
    for above in (root, *root.parents):
        if (above / ".git").exists():
            below = root.relative_to(above).as_posix()
            return "" if below == "." else f"{below}/"
    return ""
