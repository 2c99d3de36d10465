"""The past revisions that pages show beside a run."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.git.renamed_between import Commits
    from roslens.dashboard.past import Past, Renamed
    from roslens.store.read import RunView


@contextmanager
def shown_past(options: argparse.Namespace, view: RunView) -> Iterator[Past | None]:
    """Yield the past revisions of the workspace that a run is of; None where none were analysed.

    Where those are of a folder above or below that of the run, it is said on standard error that they are not shown.

    Raises:
        RoslensError: they cannot be read, or they may be of someone else.
    """
    from roslens.cli.past.past_repositories import behind_heads
    from roslens.cli.past.past_store import kept_past
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.dashboard.past import Past
    from roslens.store.trends import Trends

    kept = None if options.no_store else kept_past(options.path)
    if kept is None:
        yield None
        return
    with kept.open() as store:
        settings = find_configuration(kept.root, None).source.workspace
        trends = Trends(store, view, behind_heads(kept.root, settings)).load()
        if trends.other_root:
            reported = f'past revisions of "{kept.root}" are not shown with a run of "{trends.other_root}"'
            print(
                f"roslens: {reported}; `roslens check {kept.root}` stores a run that they are shown with",
                file=sys.stderr,
            )
            yield None
            return
        yield Past(trends, _renamed_in(view.header.root)) if len(trends.points) > 1 else None


def _renamed_in(root: str) -> Renamed:
    from roslens.cli.git.renamed_between import renamed_between

    def renamed(before: Commits, after: Commits) -> Mapping[str, str]:
        return renamed_between(Path(root), before, after)

    return renamed
