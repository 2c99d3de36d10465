"""Writes a table of changes: ``python -m distribution_changes REPOSITORY NAME DISTRO=REVISION DISTRO=REVISION …``.

REPOSITORY is a Git repository, NAME what it is called in the table, and each REVISION the branch or commit that stands
for a distribution, in order of release. Headers, modules of Python, names of plug-ins and their parameters that a
distribution has and the next one has not are rows; what the newest revision marks as deprecated goes to standard error,
for whoever adds rows by hand.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from distribution_changes.deprecations import marked
from distribution_changes.headers import header_rows
from distribution_changes.modules import module_rows
from distribution_changes.plugins import parameter_rows, plugin_rows
from distribution_changes.revision import Revision
from distribution_changes.row import Row, lines_of


def main(repository: str, name: str, *given: str) -> None:
    """Write the table to standard output."""
    revisions = [Revision(Path(repository), *one.partition("=")[::2]) for one in given]
    sys.stdout.write("\n".join(table(name, revisions)) + "\n")
    for line in sorted(set(marked(revisions[-1]))):
        sys.stderr.write(f"{line}\n")


def table(name: str, revisions: Sequence[Revision]) -> Iterator[str]:
    """Yield the lines of a table."""
    spans = ", ".join(f"{one.distro} {one.date}" for one in revisions)
    yield "# Written by `python -m distribution_changes`, but for rows below «By hand»."
    yield ""
    yield "[about]"
    yield f'source = "{name}: {spans}"'
    for kind, rows in (
        ("header", header_rows(revisions)),
        ("module", module_rows(revisions)),
        ("plugin", plugin_rows(revisions)),
        ("parameter", parameter_rows(revisions)),
    ):
        yield from _rows(kind, rows)


def _rows(kind: str, rows: Sequence[Row]) -> Iterator[str]:
    if rows:
        yield ""
        yield f"[{kind}]"
        yield from lines_of(rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
