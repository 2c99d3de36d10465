"""The computation graphs that the pages of a run show: those that it keeps, or assembled from its files."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.graph.graph_configurations import Assembled

if TYPE_CHECKING:
    from roslens.cli.graph.graph_configurations import Named
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.cli.terminal.streams import LineProgress, NoProgress, TerminalProgress
    from roslens.dashboard.site import Site
    from roslens.model.result import RunHeader
    from roslens.source.progress import Progress
    from roslens.source.settings import SourceSettings
    from roslens.store.read import RunView

    FinishedProgress = TerminalProgress | LineProgress | NoProgress


def add_shown_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--no-graph``."""
    parser.add_argument("--no-graph", action="store_true", help="leave the computation graphs of launch files out")


def site_with_graphs(view: RunView, options: argparse.Namespace, progress: FinishedProgress) -> Site:
    """Return the site of a run with the computation graphs that the options ask for."""
    from roslens.cli.graph.site import site_of

    if options.no_graph:
        return site_of(view)
    if (kept := kept_graphs(view, quiet=options.quiet)) is not None:
        return site_of(view, kept)
    try:
        shown, note = shown_graphs(view, cache_of(view, options), progress, quiet=options.quiet)
    finally:
        progress.finish()
    return site_of(view, shown, note, counted=False)


def cache_of(view: RunView, options: argparse.Namespace) -> Path | None:
    """Return the file in which is kept what was learned of files; None where the options keep nothing."""
    from roslens.cli.workplace.workplace import CACHE, find_folder, own_folder

    if options.no_cache:
        return None
    apart = options.no_store or options.changed
    return (own_folder(Path(view.header.root)) if apart else find_folder(options.path)) / CACHE


def kept_graphs(view: RunView, *, quiet: bool = False) -> Assembled | None:
    """Return the configurations that a run keeps, whatever became of its files; None where it keeps none."""
    from roslens.cli.graph.graph_configurations import MOST, Assembled, most_telling, telling_first

    every = view.configurations()
    found = tuple(one for one in every if not one.configuration.unstarted)
    if not found:
        return None
    declared = bool(_settings_of(view.header).graph.configurations)
    among = view.header.graphs.among if view.header.graphs is not None else 0
    if not declared and len(found) > MOST:
        among = len(found)
        largest = most_telling(
            {one.name: tuple(sorted(node.name for node in one.configuration.nodes)) for one in found}
        )
        if not quiet:
            _tell_left_out(len(largest), len(found))
        found = tuple(one for one in found if one.name in largest)
    kept = Assembled(
        {one.name: one.configuration for one in found},
        {one.name: one.findings for one in found},
        unstarted=tuple(one.configuration for one in every if one.configuration.unstarted),
        among=among,
    )
    return kept if declared else telling_first(kept)


def shown_graphs(
    view: RunView, cache: Path | None, progress: Progress, *, quiet: bool = False
) -> tuple[Assembled | None, str]:
    """Return the configurations that a run declares, or of its largest launch files that no other includes.

    They are read from the files as they are now. Besides them stands what readers have to know of that: nothing where
    files are as the run saw them. None where the workspace is not there any more. What could not be assembled is
    reported on standard error.

    Args:
        view: the run: it knows where its workspace is and what the user chose.
        cache: the file in which is kept what was learned of files; None keeps nothing.
        progress: who watches.
        quiet: no hints.
    """
    header = view.header
    if not Path(header.root).is_dir():
        return None, ""
    read = read_graphs(header, cache, progress, quiet=quiet)
    return read.found, note_of(view, read)


class ReadGraphs(msgspec.Struct, frozen=True):
    """What was read from the files of a workspace.

    Attributes:
        found: the configurations.
        left_out: what readers have to know of those that are not shown.
        paths: of the files that there are now.
    """

    found: Assembled
    left_out: str
    paths: frozenset[str]


def read_graphs(header: RunHeader, cache: Path | None, progress: Progress, *, quiet: bool = False) -> ReadGraphs:
    """Read the configurations of a run from its files; see :func:`shown_graphs`."""
    from roslens.cli.graph.graph_configurations import assembled, telling_first
    from roslens.cli.graph.graph_source import GraphSource

    settings = _settings_of(header)
    progress.step("Reading launch files and code", 0)
    with GraphSource(header.root, settings, "roslens.toml", {}, cache=cache, jobs=0, progress=progress) as source:
        chosen, left_out = _chosen(source, quiet=quiet)
        found = assembled(source, chosen, progress)
        paths = source.paths
    for failure in found.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    return ReadGraphs(found if settings.graph.configurations else telling_first(found), left_out, paths)


def note_of(view: RunView, read: ReadGraphs) -> str:
    """Return what readers have to know of graphs that were read now, besides a run."""
    from roslens.cli.workplace.changed_files import changed_files

    return " ".join(filter(None, (read.left_out, _note(changed_files(view, read.paths)))))


def _note(changed: tuple[str, ...]) -> str:
    from roslens.cli.workplace.changed_files import and_more

    if not changed:
        return ""
    return (
        "This is the graph of the files as they are now, not of those that the run saw: it keeps none, and "
        f"{and_more(changed)} changed since. `roslens check` without --no-graph keeps graphs with a run."
    )


def _settings_of(header: RunHeader) -> SourceSettings:
    from roslens.source.settings import SourceSettings

    try:
        return msgspec.convert(header.configuration, SourceSettings)
    except msgspec.ValidationError:
        # A run of another version of roslens may have been asked for something else.
        return SourceSettings()


def _chosen(source: GraphSource, *, quiet: bool) -> tuple[tuple[Named, ...], str]:
    """Return the configurations that are shown, and what readers have to know of those that are not."""
    from roslens.cli.graph.graph_configurations import chosen_configurations, note_of_left_out

    chosen = chosen_configurations(source)
    if not chosen.left_out:
        return chosen.named, ""
    if not quiet:
        _tell_left_out(len(chosen.named), chosen.scope().among)
    return chosen.named, note_of_left_out(len(chosen.named), chosen.scope().among)


def _tell_left_out(shown: int, all_: int) -> None:
    print(
        f"roslens: the computation graphs of {shown} of {all_} launch files are shown, those that together start most "
        "nodes; [graph.configurations] in roslens.toml chooses others",
        file=sys.stderr,
    )
