"""`roslens serve --history`: what a watch kept, as the live page and its past."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roslens.cli.page.watch_page import PageSource
from roslens.cli.react.react_page import journal_clock
from roslens.model.errors import UsageError
from roslens.store.past.open_past import open_past


@contextmanager
def history_beside(path: Path) -> Iterator[PageSource]:
    """Open a history until the context is left; give what shows it, beginning with its end.

    Raises:
        UsageError: nothing is kept in it.
        StoreError: it is not there, or no history that can be read.
    """
    with open_past(path) as recall:
        span = recall.span()
        page = PageSource(path.name, clock=journal_clock, live=False, recorded=False, steady=time.monotonic)
        page.remember(recall)
        if span is None or not page.end_at(span[1]):
            raise UsageError(
                f"nothing is kept in {path}", where="--history", expected="a history of a watch that has begun",
            )  # fmt: skip
        yield page
