"""Analysis of a workspace by its configuration and the options of ``roslens check``."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Mapping
from contextlib import AbstractContextManager, closing, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.graph.graph_stage import graph_look
from roslens.cli.workplace.process_option import process_look, with_process
from roslens.cli.workplace.tools_option import with_tools, without_programs_of_models
from roslens.cli.workplace.workplace import ANSWERS, CACHE, kept_in, own_folder

if TYPE_CHECKING:
    from roslens.cli.terminal.streams import LineProgress, NoProgress, TerminalProgress
    from roslens.cli.workplace.configuration import Configuration
    from roslens.source.answer import Answer
    from roslens.source.engines.cluster_ahead import ClusterAhead
    from roslens.source.engines.told_progress import ToldProgress
    from roslens.source.settings import SourceSettings
    from roslens.store.runs import Store

    FinishedProgress = TerminalProgress | LineProgress | NoProgress


def add_kept_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what a command that shows a run keeps below the workspace: with both options, nothing."""
    parser.add_argument("--no-cache", action="store_true", help="read every file again, and keep nothing of it")
    parser.add_argument("--changed", action="store_true", help="show the last run of `roslens check --changed`")
    parser.add_argument(
        "--no-store", action="store_true", help="analyse the workspace now instead of using a stored run"
    )


def analysed(
    options: argparse.Namespace,
    root: Path,
    configuration: Configuration,
    *,
    environment: Mapping[str, str],
    store: Store,
    progress: FinishedProgress | ToldProgress,
    begun: float,
    unchanged: Mapping[str, str] | None = None,
) -> Answer:
    """Analyse, and keep the run in a store; messages of the cache go to standard error.

    Args:
        options: ``paths``, ``model``, ``jobs``, ``graph``, ``no_cache`` and ``no_store`` of ``roslens check``.
        root: of the workspace.
        configuration: of the user.
        environment: variables that conditions of manifests see.
        store: receives the run.
        progress: who watches; it is finished.
        begun: when the command began, a ``time.monotonic()``.
        unchanged: hashes of files by path; packages of which all files have these are left out.

    Raises:
        RoslensError: see :mod:`roslens.cli.terminal.boundary`.
    """
    import time
    from datetime import datetime, timezone

    from roslens.source.pipeline import Clock, analyse
    from roslens.store.cache import Cache

    settings = settings_of(options, configuration, environment)
    now = time.time()
    utc = datetime.fromtimestamp(now, tz=timezone.utc).isoformat(timespec="seconds")
    kept = None if options.no_cache else own_folder(root) / CACHE
    answers = kept.with_name(ANSWERS) if kept is not None else None
    changed = unchanged is not None
    beyond = graph_look(options, configuration, settings, root, kept, progress, changed=changed)
    with Cache.open(kept) as cache, _engine(options, configuration, root, store) as engine:
        try:
            outcome = analyse(
                options.paths,
                settings,
                store=store,
                cache=cache,
                clock=Clock(utc, now, lambda: time.monotonic() - begun),
                base=Path(configuration.base or "."),
                jobs=configuration.jobs if options.jobs is None else options.jobs,
                progress=progress,
                log=None if options.no_store else kept_in(root) / "log",
                programs=beyond is not None and kept is not None,
                beyond=beyond,
                engine=engine,
                unchanged=unchanged,
                look_back=None if changed else process_look(options, settings, answers),
            )
        finally:
            progress.finish()
        for warning in cache.warnings:
            print(f"roslens: {warning}", file=sys.stderr)
    return outcome


def _engine(
    options: argparse.Namespace, configuration: Configuration, root: Path, store: Store
) -> AbstractContextManager[str | ClusterAhead]:
    """Return where packages are measured; where all of them are new, a cluster is connected to from now on."""
    from roslens.source.engines.executor import is_cluster

    engine = getattr(options, "engine", None) or configuration.engine
    if not is_cluster(engine) or store.latest() is not None:
        return nullcontext(engine)
    from roslens.source.engines.cluster_ahead import ClusterAhead
    from roslens.source.measure.make_ready import make_ready

    return closing(ClusterAhead(engine, str(root), make_ready))


def settings_of(
    options: argparse.Namespace, configuration: Configuration, environment: Mapping[str, str]
) -> SourceSettings:
    """Return what determines the result, from configuration, options and environment."""
    import msgspec

    from roslens.source.workspace.conditions import environment_of

    settings = configuration.source
    if options.model:
        base = Path(configuration.base or ".")
        names = [_from_base(name, base) for given in options.model for name in given.split(",") if name]
        settings = msgspec.structs.replace(
            settings, models=tuple(dict.fromkeys(names)), tools=without_programs_of_models(settings.tools)
        )
    settings = with_process(options, with_tools(options, settings))
    # Conditions of manifests (REP-149) use the user's environment, unless the configuration overrides it.
    seen = {**environment_of(environment), **settings.workspace.environment}
    workspace = msgspec.structs.replace(settings.workspace, environment=seen)
    distro = _distro(options, configuration)
    return msgspec.structs.replace(settings, workspace=workspace, distro=distro)


def _distro(options: argparse.Namespace, configuration: Configuration) -> str:
    """Return the distribution that the user says the workspace is for; empty where nobody says one.

    Raises:
        UsageError: there is none of that name.
    """
    from roslens.model.errors import UsageError
    from roslens.plugins.nearest import did_you_mean
    from roslens.source.distributions.known_distributions import distributions

    given = getattr(options, "distro", None) or ""
    if given and given not in distributions():
        if getattr(options, "fetch", False):
            return ""
        raise UsageError(
            f"--distro {given!r}",
            expected=f"one of {', '.join(distributions())}",
            advice=did_you_mean(given, distributions()),
        )
    source = configuration.source
    named = source.workspace.environment.get("ROS_DISTRO", "")
    return given or source.distro or (named if named in distributions() else "")


def _from_base(name: str, base: Path) -> str:
    """Return a model of the command line as the configuration would name it, by a path from the folder of that."""
    from roslens.judge.quality.quality_model import builtin_models

    if name in builtin_models() or not Path(name).is_file():
        return name
    return os.path.relpath(name, base)
