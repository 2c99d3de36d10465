"""Files of a workspace that were renamed from one state of its repositories to another."""

from __future__ import annotations

from pathlib import Path

from roslens.model.errors import UsageError

Commits = tuple[tuple[str, str], ...]
"""By place of the repository below the root of the workspace; with ``+`` where files differed from the commit."""


def renamed_between(root: Path, before: Commits, after: Commits) -> dict[str, str]:
    """Return the later path of each renamed file by its earlier one; none if git cannot determine them."""
    from roslens.cli.git.git_renames import renamed_files
    from roslens.cli.git.git_repository import repository_of

    found: dict[str, str] = {}
    later = dict(after)
    for place, commit in before:
        then, now = commit.rstrip("+"), later.get(place, "").rstrip("+")
        if not then or not now or then == now:
            continue
        try:
            renamed = renamed_files(repository_of(str(root / place)), then, now)
        except UsageError:
            continue
        above = "" if place == "." else f"{place}/"
        found.update({f"{above}{old}": f"{above}{new}" for old, new in renamed.items()})
    return found
