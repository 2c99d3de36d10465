"""The run that pages show: one that was kept, or one made now of which nothing is kept."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roslens.cli.check.analysed import analysed
from roslens.cli.check.kept_changed_run import changed_run
from roslens.cli.workplace.trust_option import admitted_by
from roslens.cli.workplace.workplace import STORE, open_store
from roslens.intake.file_budget import is_watched
from roslens.model.errors import UsageError
from roslens.source.engines.told_progress import ToldProgress, heard_by
from roslens.source.engines.watched_reader import Heard, WatchedReader

if TYPE_CHECKING:
    from roslens.cli.check.analysed import FinishedProgress
    from roslens.cli.workplace.configuration import Configuration
    from roslens.store.read import RunView


@contextmanager
def shown_run(options: argparse.Namespace, progress: FinishedProgress) -> Iterator[RunView]:
    """Yield the run that the options name; with ``--no-store`` one that is made now and is gone with the context.

    Raises:
        RoslensError: there is no run, or the workspace cannot be analysed.
    """
    if options.changed:
        if options.no_store or options.number is not None:
            raise UsageError("--changed with --run or --no-store", expected="one of them")
        with changed_run(options.path) as narrowed:
            yield narrowed
        return
    if not options.no_store:
        with open_store(options.path) as store:
            yield store.view(options.number)
        return
    import os
    import time

    from roslens.children.scratch_folder import ScratchFolder
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.source.workspace.find import root_of
    from roslens.store.runs import Store

    begun = time.monotonic()
    if options.number is not None:
        raise UsageError(f"--run {options.number} with --no-store", expected="one of them")
    root = root_of([options.path])
    asked = argparse.Namespace(
        paths=[options.path],
        model=None,
        jobs=None,
        graph=False if options.no_graph else None,
        no_cache=options.no_cache,
        no_store=True,
    )
    # Not in memory: pages are written and served by several readers at once.
    with ScratchFolder("run") as folder:
        kept = Path(folder, STORE)
        given = (asked, root, admitted_by(options, find_configuration(root, None), root), dict(os.environ), kept, begun)
        if is_watched():
            run = _analysed_into(progress, *given)
        else:
            reader = WatchedReader(str(root))
            try:
                run = reader.ask(analysed_for, *given, heard=heard_by(progress))
            finally:
                reader.end()
                progress.finish()
        with Store.open(kept) as store:
            yield store.view(run)


def analysed_for(tell: Heard, *given: Any) -> int | None:
    """Analyse in a process that reads for another one, which is told of the progress; see :func:`_analysed_into`."""
    return _analysed_into(ToldProgress(tell), *given)


def _analysed_into(
    progress: FinishedProgress | ToldProgress,
    asked: argparse.Namespace,
    root: Path,
    configuration: Configuration,
    environment: Mapping[str, str],
    kept: Path,
    begun: float,
) -> int | None:
    """Analyse a workspace, put the run into a store, and return its number there."""
    from roslens.store.runs import Store

    with Store.open(kept) as store:
        outcome = analysed(
            asked, root, configuration, environment=environment, store=store, progress=progress, begun=begun
        )
    return outcome.run
