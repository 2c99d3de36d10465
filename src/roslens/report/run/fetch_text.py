"""What became of repositories that were fetched, as text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from roslens.model.failure import Failure

Row = tuple[str, str, str, int, str, str, tuple[str, ...]]
"""How it came, name, commit, number of commits, day, failure and notes of a repository."""

_MOST = 40
"""Repositories of which each has a line; of more only those that failed or have a note, unless all are asked for."""


def fetch_text(rows: Sequence[Row], failures: Sequence[Failure], *, verbose: bool = False, quiet: bool = False) -> str:
    """Return a line for each repository and what went wrong, and one that sums it up.

    Args:
        rows: what became of each.
        failures: of what is no repository.
        verbose: whether each has a line, however many there are.
        quiet: whether only what failed has one.
    """
    width = max((len(row[1]) for row in rows), default=0)
    lines = []
    for how, name, commit, commits, day, failure, notes in rows:
        if failure:
            lines.append(f"failed   {name:<{width}}  {failure}")
            continue
        if not quiet and (verbose or notes or len(rows) <= _MOST):
            count = f"{commits:>6,} commits" if commits else "       shallow"
            lines.append(f"{how:<8} {name:<{width}}  {commit[:12]}  {count}  {day[:10]}")
            lines += [f"         {'':<{width}}  {note}" for note in notes]
    lines += [f"failed   {one}" for one in failures]
    if not quiet:
        counted = Counter("failed" if row[5] else row[0] for row in rows)
        counted["failed"] += len(failures)
        parts = [f"{counted[how]:,} {how}" for how in ("fetched", "updated", "kept", "failed") if counted[how]]
        lines.append(f"{len(rows):,} repositories: {', '.join(parts)}" if parts else "no repository is wanted")
    return "".join(f"{line}\n" for line in lines)
