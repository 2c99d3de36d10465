"""Which findings of a run ``roslens check`` looks at: new ones since a baseline, those in changed files, or all."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.model.errors import RoslensError, UsageError

if TYPE_CHECKING:
    from roslens.cli.check.baseline import Baseline
    from roslens.cli.check.kept_changed_run import KeptChangedRun
    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.failure import Failure
    from roslens.model.finding import Finding
    from roslens.report.run.reported import Wanted
    from roslens.store.read import RunView
    from roslens.store.runs import Store


class Scope(msgspec.Struct, frozen=True):
    """A run as it is shown and as it is judged, and what both are compared with.

    ``whole`` is the run, ``shown`` has what reports show, ``judged`` what fails the check; ``baseline`` is None where
    there is none; ``changed`` says which files count where only changed ones do.
    """

    whole: RunView
    shown: RunView
    judged: RunView
    wanted: Wanted
    baseline: Baseline | None = None
    changed: KeptChangedRun | None = None


def unchanged_files(options: argparse.Namespace, root: Path) -> Mapping[str, str] | None:
    """Return git's hashes of the files in the revision of ``--changed`` by their paths; None without it.

    Raises:
        UsageError: there is no such revision, or the options contradict each other.
    """
    if options.new_only and not options.baseline:
        raise UsageError("--new-only without --baseline", expected="--baseline REV, FILE or RUN")
    if options.changed is None:
        return None
    if options.baseline:
        raise UsageError(
            "--changed with --baseline",
            expected="one of them",
            advice=f"--baseline {options.changed} --new-only shows new ones",
        )
    from roslens.cli.git.revision import committed_blobs

    return committed_blobs(root, options.changed)


def left_to_whole_run(files: int) -> str:
    """Return what is said where unchanged files of the packages were not looked at."""
    many = "1 unchanged file" if files == 1 else f"{files:,} unchanged files"
    return (
        f"{many} of these packages left out, and with them limits on classes and packages, and lines that are copied: "
        "a run without --changed has these"
    )


def scope_of(
    options: argparse.Namespace,
    view: RunView,
    wanted: Wanted,
    *,
    root: Path,
    store: Store,
    configuration: Configuration,
    unchanged: Mapping[str, str] | None,
    fresh: bool,
) -> Scope:
    """Return what is shown and judged of a run; a baseline that cannot be read becomes a failure of it.

    ``fresh`` is whether the run was made just now.
    """
    if unchanged is not None:
        from roslens.cli.check.kept_changed_run import KeptChangedRun, narrowed_to

        differs = {file.path: unchanged.get(file.path) != file.content_hash for _, file in view.files()}
        changed = KeptChangedRun(
            view.id,
            options.changed,
            tuple(path for path, is_changed in differs.items() if is_changed),
            tuple(path for path, is_changed in differs.items() if not is_changed),
        )
        narrowed = narrowed_to(view, changed.paths, changed.others)
        return Scope(narrowed, narrowed, narrowed, wanted, changed=changed)
    if not options.baseline:
        return Scope(view, view, view, wanted)
    from roslens.cli.check.baseline import analysed_revision, failed, read_baseline

    try:
        baseline = read_baseline(
            options.baseline,
            root,
            store,
            view,
            lambda revision: analysed_revision(revision, options, root, configuration),
            fresh=fresh,
        )
    except RoslensError as error:
        return _without(view, wanted, failed(error))
    return _compared(view, wanted, baseline, new_only=options.new_only)


def _without(view: RunView, wanted: Wanted, failure: Failure) -> Scope:
    from roslens.store.narrowed import NarrowedView

    narrowed = NarrowedView(view, None, (failure,))
    return Scope(view, narrowed, narrowed, wanted)


def _compared(view: RunView, wanted: Wanted, baseline: Baseline, *, new_only: bool) -> Scope:
    from roslens.compare.known_findings import since_baseline
    from roslens.model.same_finding import key_of_finding
    from roslens.store.narrowed import NarrowedView

    files = {file.path for _, file in view.files()}
    before, now, title = _alike(baseline, view)
    found = since_baseline(before, now, files, baseline.renamed)
    judged = NarrowedView(view, lambda finding: key_of_finding(finding) in found.new)
    compared = msgspec.structs.replace(wanted, baseline=title, new=found.new, gone=found.gone)
    return Scope(view, judged if new_only else view, judged, compared, baseline)


def _alike(baseline: Baseline, view: RunView) -> tuple[Sequence[Finding], Sequence[Finding], str]:
    """Return the findings that are compared, and the name of the baseline.

    Where one side did not look at computation graphs, what the other found in them is neither new nor gone.
    """
    from roslens.cli.check.baseline import GRAPH_SCOPE, looked_at_graphs

    now = list(view.findings())
    if baseline.graphs == looked_at_graphs(view):
        return baseline.findings, now, baseline.title
    graph_rules = {rule.id for rule in view.rules() if rule.scope == GRAPH_SCOPE}

    def others(findings: Sequence[Finding]) -> list[Finding]:
        return [one for one in findings if one.rule not in graph_rules and not one.rule.startswith("graph.")]

    if baseline.graphs:
        return others(baseline.findings), now, baseline.title
    return (
        baseline.findings,
        others(now),
        f"{baseline.title} (which has no computation graphs: theirs are not compared)",
    )
