"""Computation graphs that are read while pages are served already, and what readers are told until then."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.graph_configurations import LOOKING

if TYPE_CHECKING:
    from roslens.dashboard.site import Site
    from roslens.source.progress import Progress
    from roslens.store.read import RunView


class GraphsBeside:
    """Reads the graphs that a run does not keep in a thread of its own, and shows them once they are there."""

    def __init__(
        self, site: Site, view: RunView, cache: Path | None, progress: Progress, *, quiet: bool = False
    ) -> None:
        """Take what is shown and where graphs are read from; see :func:`roslens.cli.shown_graphs.shown_graphs`."""
        self._site, self._view, self._cache, self._quiet = site, view, cache, quiet
        self._progress = progress
        self._done = self._total = 0
        self._tell()

    def start(self) -> None:
        """Begin; the thread ends with the process."""
        threading.Thread(target=self._read, name="graphs", daemon=True).start()

    def step(self, title: str, total: int) -> None:
        """Begin a step of reading."""
        if title == LOOKING:
            self._done, self._total = 0, total
            self._tell()
        self._progress.step(title, total)

    def advance(self, count: int = 1, item: str = "") -> None:
        """Say that ``count`` more items are done."""
        if self._total and self._done < self._total:
            self._done += count
            self._tell()
        self._progress.advance(count, item)

    def _tell(self) -> None:
        count = f" ({self._done} of {self._total})" if self._total else ""
        self._site.reading = f"Computation graphs are being read{count}"

    def _read(self) -> None:
        from roslens.cli.shown_graphs import shown_graphs

        try:
            found, note = shown_graphs(self._view, self._cache, self, quiet=self._quiet)
        except Exception as error:  # noqa: BLE001 - the pages of the run stay, whatever graphs are like
            print(f"roslens: computation graphs could not be read: {error}", file=sys.stderr)
            self._site.reading = f"Computation graphs could not be read: {error}"
            return
        finally:
            finish: Callable[[], None] | None = getattr(self._progress, "finish", None)
            if finish is not None:
                finish()
        if found is not None:
            self._site.show_graphs(found.configurations, found.findings, note, counted=False, unstarted=found.unstarted)
        self._site.reading = ""
