"""What became of a repository, as the row that reports show."""

from __future__ import annotations

from roslens.source.fetch.taken import Taken


def fetch_row(taken: Taken) -> tuple[str, str, str, int, str, str, tuple[str, ...]]:
    """Return how it came, name, commit, number of commits, day, failure and notes."""
    return (
        taken.how.value,
        taken.wanted.name,
        taken.commit,
        taken.commits,
        taken.day,
        taken.failure,
        taken.notes,
    )
