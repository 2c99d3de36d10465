"""The computation graphs that the pages of a run show: assembled from its workspace as it is now."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.graph_configurations import Assembled, Named
    from roslens.cli.graph_source import GraphSource
    from roslens.cli.streams import LineProgress, NoProgress, TerminalProgress
    from roslens.dashboard.site import Site
    from roslens.model.result import RunHeader
    from roslens.source.progress import Progress
    from roslens.store.read import RunView

    FinishedProgress = TerminalProgress | LineProgress | NoProgress


def add_shown_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--no-graph``."""
    parser.add_argument("--no-graph", action="store_true", help="leave the computation graphs of launch files out")


def site_with_graphs(view: RunView, options: argparse.Namespace, progress: FinishedProgress) -> Site:
    """Return the site of a run with the computation graphs that the options ask for."""
    from roslens.cli.site import site_of
    from roslens.cli.workplace import CACHE, find_folder

    if options.no_graph:
        return site_of(view)
    try:
        shown = shown_graphs(view.header, find_folder(options.path) / CACHE, progress, quiet=options.quiet)
    finally:
        progress.finish()
    return site_of(view, shown)


def shown_graphs(header: RunHeader, cache: Path, progress: Progress, *, quiet: bool = False) -> Assembled | None:
    """Return the configurations that a run declares, or of its largest launch files that no other includes.

    None where the workspace is not there any more. What could not be assembled is told on standard error.

    Args:
        header: of the run: it knows where its workspace is and what the user chose.
        cache: the file in which is kept what was learned of files.
        progress: who watches.
        quiet: no hints.
    """
    import msgspec

    from roslens.cli.graph_configurations import assembled
    from roslens.cli.graph_source import GraphSource
    from roslens.source.settings import SourceSettings

    if not Path(header.root).is_dir():
        return None
    try:
        settings = msgspec.convert(header.configuration, SourceSettings)
    except msgspec.ValidationError:
        # A run of another version of roslens may have been asked for something else.
        settings = SourceSettings()
    progress.step("Reading launch files and code", 0)
    with GraphSource(header.root, settings, "roslens.toml", {}, cache=cache, jobs=0, progress=progress) as source:
        found = assembled(source, _chosen(source, quiet=quiet), progress)
    for failure in found.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    return found


def _chosen(source: GraphSource, *, quiet: bool) -> tuple[Named, ...]:
    from roslens.cli.graph_configurations import largest, named_configurations

    named = named_configurations(source)
    if source.settings.graph.configurations:
        return named
    chosen = largest(source, named)
    if len(chosen) < len(named) and not quiet:
        print(
            f"roslens: the computation graphs of {len(chosen)} of {len(named)} launch files are shown, those that start"
            " most nodes; [graph.configurations] in roslens.toml chooses others",
            file=sys.stderr,
        )
    return chosen
