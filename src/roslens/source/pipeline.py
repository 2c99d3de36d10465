"""One analysis run, from paths to a complete run in the store.

find packages -> take inventory of their files -> (nothing changed? the old run stands) -> measure the
packages that changed -> let plug-ins look at them -> judge -> keep -> measure the workspace -> complete.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.failure import Failure
from roslens.model.quantity import Quantity
from roslens.model.result import RunHeader, WorkspaceResult
from roslens.model.source import Language, SourceFile
from roslens.source.executor import executor_for
from roslens.source.inventory import Inventory, take_inventory
from roslens.source.keys import analyser_version, key_of
from roslens.source.progress import Progress, Silent
from roslens.source.settings import SourceSettings
from roslens.source.workspace.find import FoundPackage, Workspace, find_workspace

if TYPE_CHECKING:
    from roslens.judge.quality_model import QualityModel
    from roslens.plugins.discovery import Discovered
    from roslens.source.analyse_package import MeasuredPackage, PackageTask
    from roslens.store.cache import Cache
    from roslens.store.runs import Store


class Clock(msgspec.Struct, frozen=True):
    """The time at which the run began: ``utc`` for readers, ``epoch_s`` to compare with files."""

    utc: str
    epoch_s: float


class Outcome(msgspec.Struct, frozen=True):
    """Which run answers the question, and whether it had to be made."""

    run: int
    fresh: bool
    measured: int
    packages: int


def analyse(
    paths: Sequence[str | Path],
    settings: SourceSettings,
    *,
    store: Store,
    cache: Cache,
    clock: Clock,
    base: Path,
    jobs: int = 0,
    progress: Progress | None = None,
    log: Path | None = None,
) -> Outcome:
    """Analyse the packages below ``paths`` and return the run that holds the result.

    Args:
        paths: folders to look into.
        settings: everything that shapes the result.
        store: where the run is kept.
        cache: what earlier runs learned of files.
        clock: when the run begins.
        base: the folder that relative plug-in and model paths start from.
        jobs: worker processes; 0 means one per processor, 1 none.
        progress: who watches.
        log: where output of plug-ins and tracebacks go.

    Raises:
        UsageError: a path does not exist.
        DocumentError: a quality model is wrong.
        StoreError: the store cannot be written.
    """
    from roslens.source.plugin_stage import discover_plugins

    watch = progress or Silent()
    watch.step("Looking for packages", 0)
    workspace = find_workspace(paths, settings.workspace)
    inventory = take_inventory(workspace, settings.workspace, cache.stats(now_s=clock.epoch_s))
    plugins = discover_plugins(settings, base)
    shaping = _shaping(settings, base, plugins)
    units = {
        found.package.id: key_of(shaping, found.package, inventory.files[found.package.id])
        for found in workspace.packages
    }
    key = key_of(units, workspace.failures, inventory.failures, plugins.failures)
    if inventory.learned:
        cache.put_stats(inventory.learned, now_s=clock.epoch_s)
    if (known := store.run_with(key)) is not None:
        return Outcome(known, fresh=False, measured=0, packages=len(units))
    return _run(_Run(workspace, inventory, settings, plugins, units, key, base, clock, jobs, log), store, cache, watch)


class _Run(msgspec.Struct, frozen=True):
    workspace: Workspace
    inventory: Inventory
    settings: SourceSettings
    plugins: Discovered
    units: dict[str, str]
    key: str
    base: Path
    clock: Clock
    jobs: int
    log: Path | None


def _shaping(settings: SourceSettings, base: Path, plugins: Discovered) -> str:
    """Return a key of everything besides files that shapes a package's result."""
    models = [_model_text(name, base) for name in settings.models]
    members = [(member.manifest.name, member.manifest.version, member.fingerprint) for member in plugins.members]
    shaping = msgspec.structs.replace(settings, plugins=())
    return key_of(analyser_version(), shaping, models, members)


def _model_text(name: str, base: Path) -> str:
    path = base / name
    return path.read_text("utf-8", "replace") if path.is_file() else name


def _run(run: _Run, store: Store, cache: Cache, watch: Progress) -> Outcome:
    from roslens.source.finish_package import Finisher
    from roslens.source.plugin_stage import PluginStage

    stage = PluginStage(run.plugins, run.settings, run.workspace, run.inventory.files, jobs=run.jobs, log=run.log)
    finisher = Finisher(run.settings, _models(run, stage.quantities), run.workspace, run.inventory.files)
    changed = [found for found in run.workspace.packages if not store.has_unit(run.units[found.package.id])]
    header = _header(run)
    with stage, store.writing(header) as writer:
        for measured in _measure(run, changed, cache, watch):
            outcome = stage.run_package(measured)
            writer.add(run.units[measured.package], finisher.finish(measured, outcome))
        fresh = {found.package.id for found in changed}
        for found in run.workspace.packages:
            if found.package.id not in fresh:
                writer.reuse(run.units[found.package.id])
        number = writer.complete(_workspace_result(run, stage, finisher), header)
    return Outcome(number, fresh=True, measured=len(changed), packages=len(run.units))


def _header(run: _Run) -> RunHeader:
    from roslens.source.commit import commit_of
    from roslens.source.versions import tool_versions

    return RunHeader(
        key=run.key,
        root=run.workspace.root,
        started=run.clock.utc,
        commit=commit_of(run.workspace.root),
        tools=tool_versions(run.plugins),
        configuration=msgspec.to_builtins(run.settings),
        models=run.settings.models,
    )
