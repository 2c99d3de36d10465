"""One analysis run, from paths to a complete run in the store.

find packages -> take inventory of their files -> (nothing changed? the old run stands) -> measure the
packages that changed -> let plug-ins look at them -> judge -> keep -> measure the workspace -> complete.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.source import Language, number_of_packages
from roslens.plugins.options import check_options
from roslens.source.answer import Answer
from roslens.source.changed_packages import left_out_of, with_changes
from roslens.source.chosen_models import chosen_models
from roslens.source.commit import last_change_of
from roslens.source.distributions.target import targets_of
from roslens.source.engines.executor import executor_for
from roslens.source.fetch.fetched_set import only_fetched
from roslens.source.inventory import take_inventory
from roslens.source.keys import key_of
from roslens.source.known_manifests import KnownManifests
from roslens.source.measure.package_task import PackageTask, package_task
from roslens.source.nameable_rules import nameable_rules
from roslens.source.owned_findings import owned_findings
from roslens.source.packaging_files import packaging
from roslens.source.plugin_stage import PluginStage, discover_plugins, is_wide, shared_out
from roslens.source.progress import Progress, Silent
from roslens.source.run_inputs import Beyond, Clock, Run, Sight, among_changes, seen_below
from roslens.source.settings import RuleSettings, SourceSettings
from roslens.source.shaping import known_quantities, manifests_of, shaping_key
from roslens.source.tools.running.stage_of_run import tool_stage
from roslens.source.workspace.acceptances import FILE_NAME as ACCEPTED
from roslens.source.workspace.acceptances import acceptances_of, read_acceptances
from roslens.source.workspace.find import FoundPackage, find_workspace
from roslens.source.workspace.silence import Silence
from roslens.source.workspace.surroundings import surroundings_of
from roslens.source.workspace_result import header_of, workspace_result

if TYPE_CHECKING:
    from roslens.model.finding import Finding
    from roslens.model.source import SourceFile
    from roslens.plugins.discovery import Discovered
    from roslens.plugins.outcome import Outcome
    from roslens.source.engines.cluster_ahead import ClusterAhead
    from roslens.source.history.past_revision import PastRevision
    from roslens.source.history.process_stage import LookBack
    from roslens.source.kept_outcomes import KeptOutcomes
    from roslens.source.measure.analyse_package import MeasuredPackage
    from roslens.source.measure.finished_package import FinishedPackage, Finishing
    from roslens.store.cache import Cache
    from roslens.store.configurations import PackedConfiguration
    from roslens.store.runs import Store
    from roslens.store.writing.write import RunWriter


KEPT_RUNS = 50
"""Older runs are removed when a new one is complete."""


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
    programs: bool = False,
    beyond: Beyond | None = None,
    unchanged: Mapping[str, str] | None = None,
    look_back: LookBack | None = None,
    revision: PastRevision | None = None,
    kept_runs: int | None = KEPT_RUNS,
    engine: str | ClusterAhead = "",
) -> Answer:
    """Analyse the packages below ``paths`` and return the run that holds the result.

    Args:
        paths: folders to look into.
        settings: everything that shapes the result.
        store: where the run is kept.
        cache: what earlier runs learned of files.
        clock: when the run begins.
        base: the folder that relative plug-in and model paths start from.
        jobs: worker processes; 0 means one per processor, or fewer where there is little to measure, 1 none.
        progress: who watches.
        log: where output of plug-ins and tracebacks go.
        programs: whether files are also kept as the programs from which a graph is extracted, from the same parse.
        beyond: a look at all of it that is part of the run.
        unchanged: hashes of files by path; packages of which all files have these are left out, and so are, where only
            sources changed, the other sources of the package.
        look_back: gives the histories that process metrics are taken from; None for none.
        revision: what the folders hold where that is a past revision of another folder.
        kept_runs: how many of the newest runs stay in the store; None for all.
        engine: where packages are measured, see :func:`roslens.source.engines.executor.executor_for`.

    Raises:
        UsageError: a path does not exist, or an option of a plug-in is wrong.
        DocumentError: a quality model is wrong.
        StoreError: the store cannot be written.
    """
    watch = progress or Silent()
    watch.step("Looking for packages", 0)
    manifests = KnownManifests(cache)
    workspace = find_workspace(paths, settings.workspace, read=manifests.read)
    manifests.keep()
    whole = workspace
    fetched, workspace = only_fetched(workspace, revision.root if revision else None)
    accepted, unread = read_acceptances(base / ACCEPTED)
    known = cache.stats(now_s=clock.epoch_s)
    inventory = take_inventory(workspace, settings.workspace, known)
    everything = workspace.packages
    left_out: dict[str, frozenset[str]] = {}
    if unchanged is not None:
        workspace = with_changes(workspace, inventory.files, unchanged)
        names = [found.package.id for found in workspace.packages]
        left_out = {name: left_out_of(inventory.files[name], unchanged) for name in names}
        beyond = among_changes(beyond, names, key_of([one.package for one in everything], inventory.files))
    seen = seen_below(paths, whole, inventory, everything)
    plugins = discover_plugins(settings, base, log)
    _check_settings(settings, plugins)
    shaping = shaping_key(settings, base, plugins)
    if is_wide([member for member in plugins.members if not member.builtin]):
        # Results of such a plug-in for one package may depend on a file of any other.
        shaping = key_of(shaping, [found.package for found in workspace.packages], inventory.files)
    tools = tool_stage(
        settings,
        workspace,
        inventory.files,
        cache,
        base=base,
        jobs=jobs or os.cpu_count() or 1,
        left_out=frozenset().union(*left_out.values()),
    )
    silence = Silence(settings.ignore, acceptances_of(accepted, inventory.files))
    every = [found.package for found in everything]
    last_change = partial(last_change_of, workspace.root)
    targets = targets_of(Path(workspace.root), every, settings.distro, settings.workspace.environment, last_change)
    around = surroundings_of(every, inventory.files, targets)
    units = {
        found.package.id: key_of(
            shaping,
            found.package,
            inventory.files[found.package.id],
            inventory.others[found.package.id],
            packaging(
                found,
                workspace.root,
                is_launched=any(file.language is Language.LAUNCH_XML for file in inventory.files[found.package.id]),
            ),
            around.get(found.package.id),
            *(sorted(left_out.get(found.package.id, ()))),
            *([tools.key_of_package(found.package.id)] if tools else ()),
            *silence.acceptances.shaping(file.path for file in found.files),
        )
        for found in workspace.packages
    }
    past = look_back(workspace, cache) if look_back is not None else None
    failures = (*workspace.failures, *unread, *(past.failures if past else ()))
    further = (*([beyond.key] if beyond else ()), *([tools.failures] if tools else ()), *([past.key] if past else ()))
    if fetched.taken:
        further = (*further, fetched)
    key = key_of(units, failures, inventory.failures, plugins.failures, accepted, *further)
    if inventory.learned:
        cache.put_stats(inventory.learned, now_s=clock.epoch_s)
    if gone := known.keys() - {file.path for found in everything for file in found.files}:
        cache.forget(gone)
    if (before := store.run_with(key)) is not None:
        return Answer(before, fresh=False, measured=0, packages=number_of_packages(units))
    return _run(
        Run(
            msgspec.structs.replace(workspace, failures=failures),
            inventory,
            settings,
            plugins,
            units,
            key,
            base,
            clock,
            jobs,
            log,
            programs,
            beyond,
            tools,
            silence,
            past,
            fetched,
            revision,
            kept_runs,
            engine,
            left_out,
            around,
            seen,
        ),
        store,
        cache,
        watch,
    )


def _check_settings(settings: SourceSettings, plugins: Discovered) -> None:
    """Report options of plug-ins and settings of rules that do not exist."""
    if settings.options:
        check_options(manifests_of(settings, plugins), settings.options)
    if settings.rules != RuleSettings():
        from roslens.source.rules.selection import check_rule_settings
        from roslens.source.rules.table import native_rules

        check_rule_settings(settings.rules, native_rules())


def _reused(run: Run, store: Store, writer: RunWriter, fresh: Collection[str]) -> set[str]:
    """Take over the packages that are as they were; return the rules that tools broke in them."""
    seen: set[str] = set()
    for found in run.workspace.packages:
        unit = run.units[found.package.id]
        if found.package.id in fresh:
            continue
        writer.reuse(unit)
        summary = store.unit_summary(unit) if run.tools is not None else None
        if summary is not None:
            seen.update(count.rule for count in summary.rules)
    return seen


def _run(run: Run, store: Store, cache: Cache, watch: Progress) -> Answer:
    from roslens.plugins.outcome import Outcome
    from roslens.source.history.judged_process import judged_process, not_judged
    from roslens.source.history.process_stage import Reported, with_process
    from roslens.source.kept_outcomes import KeptOutcomes
    from roslens.source.measure.finish_package import Finisher
    from roslens.source.measure.finished_package import FinishedPackage, Finishing, rules_in

    models = chosen_models(run.settings.models, run.base, known_quantities(run.plugins))
    wanted = frozenset(constraint.quantity for model in models for constraint in model.constraints)
    files = run.inventory.files
    packages = {found.package.id: found.package for found in run.workspace.packages}
    changed = [found for found in run.workspace.packages if not store.has_unit(run.units[found.package.id])]
    if run.tools is not None:
        run.tools.run((found.package.id for found in changed), watch)
    header = header_of(run)
    rest: list[Outcome] = []
    stage = PluginStage(
        run.plugins, run.settings, wanted, run.workspace, files, jobs=run.jobs or os.cpu_count() or 1, log=run.log
    )
    seen: set[str] = set()
    lost = False
    failures = (*run.workspace.failures, *run.inventory.failures)
    finisher = Finisher(
        run.settings,
        models,
        packages,
        files,
        failures,
        run.silence,
        nameable_rules(run.settings, models, stage.rules),
    )
    alone = not stage.members and run.tools is None and not run.silence.acceptances.entries
    finishing = Finishing(run.settings, models, failures, brief=run.revision is not None) if alone else None
    with (
        stage,
        store.writing(header, lambda who: watch.step(f"Waiting for another run ({who})", 0)) as writer,
    ):
        kept = KeptOutcomes(cache, run.units)
        for measured, said in _looked_at(stage, _measured(run, changed, cache, watch, finishing), kept, rest):
            if isinstance(measured, FinishedPackage):
                seen.update(measured.rules)
                writer.add_rows(run.units[measured.package], measured.rows)
                continue
            if run.tools is not None:
                said += run.tools.outcome(measured)
            result = finisher.finish(measured, said)
            seen.update(rules_in(result))
            key = run.key_kept(run.units[measured.package], lost=measured.lost)
            lost = lost or measured.lost
            writer.add(key, result, brief=run.revision is not None)
        seen |= _reused(run, store, writer, fresh={found.package.id for found in changed})
        configurations: tuple[PackedConfiguration, ...] = ()
        beside: tuple[Finding, ...] = ()
        if run.beyond is not None:
            sight = run.beyond.look(run.seen)
            beside = sight.outcome.findings
            rest.append(msgspec.structs.replace(sight.outcome, findings=()))
            configurations = sight.configurations
            header = msgspec.structs.replace(header, graphs=sight.graphs)
        reported = Reported((), not_judged(models))
        if run.past is not None:
            paths = {package.id: package.path for package in packages.values()}
            reported = Reported(*run.past.tell(paths, files, writer.function_sums("cyclomatic_complexity")))
            beside += judged_process(models, reported.process)
        owned, none = owned_findings(beside, packages.values(), files)
        rest.append(Outcome(none, failures=reported.failures if run.past is None else ()))
        whole = workspace_result(run, stage, models, owned, rest, seen, writer.set_aside_by())
        if run.past is not None:
            whole = with_process(whole, reported)
        kept_as = run.key_kept(run.key, lost=lost)
        header = msgspec.structs.replace(header, key=kept_as, seconds=round(run.clock.elapsed_s(), 3))
        number = writer.complete(whole, header, configurations)
    if run.kept_runs is not None:
        store.prune(run.kept_runs)
    return Answer(
        number,
        fresh=True,
        measured=number_of_packages(found.package.id for found in changed),
        packages=number_of_packages(run.units),
        left_out=sum(map(len, run.left_out.values())),
    )


BYTES_A_WORKER = 500_000
"""Starting one more worker takes as long as measuring this many bytes: no run waits for an unrequested one."""


def _measured(
    run: Run, changed: Sequence[FoundPackage], cache: Cache, watch: Progress, finishing: Finishing | None
) -> Iterator[MeasuredPackage | FinishedPackage]:
    """Measure packages, the largest first, and keep what was learned of their files."""
    from roslens.source.measure.analyse_package import nothing_measured
    from roslens.source.measure.measured_packages import measured_packages

    tasks = sorted((_task(run, found, cache) for found in changed), key=lambda task: -_bytes(task))
    watch.step("Measuring packages", len(tasks))
    useful = 0 if run.jobs else 1 + sum(map(_bytes, tasks)) // BYTES_A_WORKER
    executor = executor_for(run.jobs, run.engine, folder=run.workspace.root, useful=useful)
    remembered = run.revision.remembered if run.revision else None
    for task, result in measured_packages(executor, tasks, remembered, finishing):
        if isinstance(result, BaseException):
            measured: MeasuredPackage | FinishedPackage = nothing_measured(task, result)
        else:
            measured = result
            cache.put(measured.analyses)
            cache.replace(measured.evaluated)
            cache.touch({*task.facts_keys.values(), *task.program_keys.values()} - measured.analyses.keys())
        watch.advance(item=measured.package)
        yield measured


def _task(run: Run, found: FoundPackage, cache: Cache) -> PackageTask:
    files = run.inventory.files[found.package.id]
    return package_task(
        found,
        files,
        run.inventory.others[found.package.id],
        root=run.workspace.root,
        settings=run.settings,
        kept=str(cache.path) if cache.path else "",
        program_keys=_program_keys(run, files) if run.programs else {},
        left_out=run.left_out.get(found.package.id, frozenset()),
        around=run.around.get(found.package.id),
    )


def _program_keys(run: Run, files: tuple[SourceFile, ...]) -> dict[str, str]:
    from roslens.source.extract.ir.program_codec import program_keys

    return program_keys(files, run.settings.macros)


def _bytes(task: PackageTask) -> int:
    return sum(file.size for file in task.files if file.language.parsed_as)


def _looked_at(
    stage: PluginStage,
    packages: Iterator[MeasuredPackage | FinishedPackage],
    kept: KeptOutcomes,
    rest: list[Outcome],
) -> Iterator[tuple[MeasuredPackage | FinishedPackage, Outcome]]:
    """Yield each package with its outcome of plug-ins; outcomes about no package go to ``rest``."""
    from roslens.plugins.outcome import Outcome
    from roslens.source.measure.analyse_package import MeasuredPackage

    if not stage.wide:
        for measured in packages:
            # Only where there are no plug-ins is one finished already.
            said = kept.of(measured, stage.run_package) if isinstance(measured, MeasuredPackage) else Outcome()
            yield measured, said
        return
    measuring = (one for one in packages if isinstance(one, MeasuredPackage))
    all_measured = sorted(measuring, key=lambda measured: measured.package)
    outcomes = [kept.of(measured, stage.run_package) for measured in all_measured]
    shares, none = shared_out(stage.run_workspace(all_measured, outcomes), stage.files)
    rest.append(none)
    for measured, outcome in zip(all_measured, outcomes, strict=True):
        share = shares.get(measured.package)
        yield measured, outcome + share if share else outcome


__all__ = ["Beyond", "Clock", "Sight", "analyse"]
