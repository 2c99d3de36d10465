"""The past revisions that pages show beside a run."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.dashboard.past import Past, Renamed
    from roslens.store.read import RunView


@contextmanager
def shown_past(options: argparse.Namespace, view: RunView) -> Iterator[Past | None]:
    """Yield the past revisions of the workspace that a run is of; None where none were analysed.

    Raises:
        RoslensError: they cannot be read, or somebody else may have made them.
    """
    from roslens.cli.past_points import commits_behind
    from roslens.cli.past_store import kept_past
    from roslens.dashboard.past import Past
    from roslens.store.trends import Trends

    kept = None if options.no_store else kept_past(options.path)
    if kept is None:
        yield None
        return
    with kept.open() as store:
        trends = Trends(store, view, commits_behind(kept.root)).load()
        yield Past(trends, _renamed_in(view.header.root)) if len(trends.points) > 1 else None


def _renamed_in(root: str) -> Renamed:
    def renamed(before: str, after: str) -> Mapping[str, str]:
        from roslens.cli.git_renames import renamed_files
        from roslens.cli.git_repository import repository_of
        from roslens.model.errors import UsageError

        try:
            return renamed_files(repository_of(root), before, after) if before and after else {}
        except UsageError:
            return {}

    return renamed
