"""The runs of past revisions of a workspace, opened to be read."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.past.past_repositories import behind_heads
from roslens.cli.past.past_store import kept_past
from roslens.cli.workplace.shared_store import shared_address
from roslens.cli.workplace.workplace import STORE, kept_in, open_store, refuse_missing
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.store.trends import Trends


@contextmanager
def trends_of(start: str) -> Iterator[Trends]:
    """Open the past revisions of the workspace that ``start`` is in, with the newest run of the tree.

    Raises:
        UsageError: none were analysed.
        StoreError: they cannot be read.
    """
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.store.trends import Trends

    refuse_missing(start)
    kept = kept_past(start)
    if kept is None:
        raise UsageError(
            f"no past revisions of {str(Path(start).resolve())!r} were analysed",
            expected="runs of them",
            advice=f"Make them: roslens history {start} --every release",
        )
    with ExitStack() as opened:
        past = opened.enter_context(kept.open())
        now = None
        if (kept_in(kept.root) / STORE).is_file() or shared_address(start):
            store = opened.enter_context(open_store(start))
            now = store.view() if store.latest() is not None else None
        settings = find_configuration(kept.root, None).source.workspace
        trends = Trends(past, now, behind_heads(kept.root, settings))
        if trends.left_out:
            reported = f"{trends.left_out} revisions that were analysed are not behind the head and are left out"
            print(f"roslens: {reported}", file=sys.stderr)
        if trends.other_root:
            reported = f'the newest run is of "{trends.other_root}" and not a point of the history of "{kept.root}"'
            print(f"roslens: {reported}; `roslens check {kept.root}` makes one", file=sys.stderr)
        if not trends.points:
            raise UsageError(
                "no past revision was analysed to its end",
                expected="runs of them",
                advice=f"Make them: roslens history {start} --every release",
            )
        yield trends
