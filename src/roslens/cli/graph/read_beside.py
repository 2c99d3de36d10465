"""Computation graphs that are read while pages are served already, and what readers see until then."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.graph.graph_configurations import LOOKING
from roslens.cli.graph.shown_graphs import cache_of, kept_graphs, note_of, read_graphs
from roslens.intake.file_budget import refused
from roslens.source.engines.told_progress import ToldProgress, heard_by
from roslens.source.engines.watched_reader import Heard, WatchedReader

if TYPE_CHECKING:
    import argparse

    from roslens.cli.graph.shown_graphs import FinishedProgress, ReadGraphs
    from roslens.dashboard.site import Site
    from roslens.model.result import RunHeader
    from roslens.source.progress import Progress
    from roslens.store.read import RunView


def site_at_once(
    view: RunView, options: argparse.Namespace, progress: FinishedProgress
) -> tuple[Site, Callable[[], None]]:
    """Return the site of a run, and what begins to read the computation graphs that it does not keep."""
    from roslens.cli.graph.site import site_of

    kept = None if options.no_graph else kept_graphs(view, quiet=options.quiet)
    site = site_of(view, kept, kept.note if kept is not None else "")
    if options.no_graph or kept is not None or not Path(view.header.root).is_dir():
        return site, progress.finish
    return site, GraphsBeside(site, view, cache_of(view, options), progress, quiet=options.quiet).start


def graphs_read(tell: Heard, header: RunHeader, cache: Path | None, quiet: bool) -> ReadGraphs:
    """Read graphs in a process that reads for another one, which is told of the progress."""
    read = read_graphs(header, cache, ToldProgress(tell), quiet=quiet)
    for path, why in sorted(refused().items()):
        print(f"roslens: {path} is left out of computation graphs: {why}", file=sys.stderr)
    return read


class GraphsBeside:
    """Reads the graphs that a run does not keep in a process of its own, and shows them once they are there."""

    def __init__(
        self, site: Site, view: RunView, cache: Path | None, progress: Progress, *, quiet: bool = False
    ) -> None:
        """Take what is shown and where graphs are read from; see :mod:`roslens.cli.graph.shown_graphs`."""
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
        """Report that ``count`` more items are done."""
        if self._total and self._done < self._total:
            self._done += count
            self._tell()
        self._progress.advance(count, item)

    def _tell(self) -> None:
        count = f" ({self._done} of {self._total})" if self._total else ""
        self._site.reading = f"Computation graphs are being read{count}"

    def _read(self) -> None:
        try:
            header = self._view.header
            reader = WatchedReader(header.root)
            try:
                read = reader.ask(graphs_read, header, self._cache, self._quiet, heard=heard_by(self))
            finally:
                reader.end()
            note = note_of(self._view, read)
        except Exception as error:  # noqa: BLE001 - the pages of the run stay, whatever graphs are like
            print(f"roslens: computation graphs could not be read: {error}", file=sys.stderr)
            self._site.reading = f"Computation graphs could not be read: {error}"
            return
        finally:
            finish: Callable[[], None] | None = getattr(self._progress, "finish", None)
            if finish is not None:
                finish()
        found = read.found
        self._site.show_graphs(found.configurations, found.findings, note, counted=False, unstarted=found.unstarted)
        self._site.reading = ""
