"""``roslens check``: analyse packages, store the run, report findings."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from roslens.cli.check.baseline import add_baseline_arguments, named_baseline
from roslens.cli.check.check_fix import fixed_scope, show_diff, take_back
from roslens.cli.check.check_gate import gated
from roslens.cli.check.check_outputs import add_output_arguments, below_repository, new_first, outputs, write_outputs
from roslens.cli.check.check_scope import left_to_whole_run, scope_of, unchanged_files
from roslens.cli.check.check_watch import add_watch_argument, refuse_others, watch_files
from roslens.cli.check.fetch_first import fetch_first
from roslens.cli.check.fetch_options import add_fetch_arguments, refuse_without_fetch
from roslens.cli.check.fix_option import add_fix_arguments, refuse_contradictions
from roslens.cli.check.kept_changed_run import STORE as CHANGED_STORE
from roslens.cli.check.kept_changed_run import keep_changed_run
from roslens.cli.check.kept_new import keep_new
from roslens.cli.graph.graph_stage import HERE, add_graph_argument, settle_graph_argument
from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED
from roslens.cli.terminal.streams import add_stream_arguments, progress_for
from roslens.cli.workplace.known_tags import refuse_unknown_tags
from roslens.cli.workplace.process_option import add_process_arguments
from roslens.cli.workplace.tools_option import add_tools_arguments, tell_not_run
from roslens.cli.workplace.trust_option import add_trust_argument, admitted_by
from roslens.cli.workplace.workplace import STORE, own_folder

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.cli.check.check_scope import Scope
    from roslens.cli.workplace.configuration import Configuration
    from roslens.model.finding import Finding
    from roslens.model.result import RuleCount
    from roslens.model.tags import TagFilter
    from roslens.report.run.reported import Wanted
    from roslens.source.answer import Answer
    from roslens.store.read import RunView
    from roslens.store.runs import Store

TEXT = "Measure and judge the packages below the given folders."
EXAMPLES = """\
  roslens check
  roslens check ~/robot_ws/src --model ros --model his
  roslens check --format json -o report.json
  roslens check -o results.sarif -o summary.md               several files, each by its ending
  roslens check --format junit=build/roslens.xml             text on the screen, JUnit in the file
  roslens check --format github                              annotations in a workflow of GitHub
  roslens check --tag 'complexity and not his' --fail-on warning
  roslens check --baseline origin/main --new-only            what this branch brings
  roslens check --baseline report.json                       all findings, new ones since a report marked
  roslens check --baseline auto --new-only                   the same; in a CI, since the target of the pull request
  roslens check --changed                                    findings in files that differ from HEAD
  roslens check --fetch --distro jazzy --repository navigation2 --into nav2
  roslens check --diff                                       what can be fixed safely, as a diff
  roslens check --fix                                        fix it; --undo-fix takes it back
  roslens check --changed --fix --fix-rule 'cpp.*'           these rules only, in changed files
  roslens check --watch                                      each file again as it is saved
  roslens check --process-metrics        also revisions, contributors, churn, ownership, hotspots: of git's history
  roslens check --graph all              the computation graph of every launch file, not only of the largest
  roslens check --no-graph               without what does not fit together once the launch files are started"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of ``roslens check``."""
    parser.add_argument("paths", nargs="*", default=HERE, metavar="PATH", help="folders to look into (default: .)")
    add_output_arguments(parser)
    parser.add_argument(
        "--model", action="append", metavar="NAME", help="quality model, built in or a file; may be given again"
    )
    parser.add_argument("--tag", metavar="EXPR", help="show only findings whose tags match, e.g. 'complexity and ros'")
    parser.add_argument(
        "--fail-on",
        choices=("note", "warning", "error", "never"),
        help="exit with 1 at this severity or above (default: error)",
    )
    parser.add_argument(
        "--accept-partial",
        action="store_true",
        default=None,
        help="do not exit with 3 for files that were parsed only in part",
    )
    parser.add_argument(
        "--jobs",
        type=int,
        metavar="N",
        help="worker processes (default: one per processor, fewer where little is to do)",
    )
    parser.add_argument(
        "--engine",
        metavar="WHERE",
        help="where packages are measured: in-process, processes, or a cluster of Dask, as tcp://scheduler:8786",
    )
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    parser.add_argument("--no-cache", action="store_true", help="read every file again")
    parser.add_argument("--no-store", action="store_true", help="keep nothing of this run")
    add_baseline_arguments(parser)
    add_watch_argument(parser)
    add_fix_arguments(parser)
    add_trust_argument(parser)
    add_graph_argument(parser)
    add_tools_arguments(parser)
    add_process_arguments(parser)
    add_stream_arguments(parser)
    parser.add_argument("--fetch", action="store_true", help="fetch first, as `roslens fetch` does, then check")
    add_fetch_arguments(parser, "with --fetch")


def run(options: argparse.Namespace) -> int:
    """Analyse, print and return the exit code.

    Raises:
        RoslensError: see :mod:`roslens.cli.terminal.boundary`.
    """
    import os
    import time

    from roslens.cli.check.analysed import analysed
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.model.tags import parse_tags
    from roslens.source.workspace.find import root_of

    begun = time.monotonic()
    settle_graph_argument(options)
    tags = parse_tags(options.tag or "")
    chosen = outputs(options.format or (), options.output or ())
    _refuse_jobs(options.jobs)
    missing = _fetch(options)
    root = root_of(options.paths)
    configuration = admitted_by(options, find_configuration(root, options.config), root)
    refuse_others(options)
    refuse_contradictions(options)
    if options.undo_fix:
        return take_back(options, root)
    unchanged = unchanged_files(options, root)
    folder = None if options.no_store else own_folder(root)
    with _store(folder, configuration, changed=unchanged is not None) as store:
        options.baseline = named_baseline(options.baseline, root, store, os.environ)

        def look() -> tuple[Answer, Scope]:
            answer = analysed(
                options,
                root,
                configuration,
                environment=dict(os.environ),
                store=store,
                progress=progress_for(options),
                begun=begun,
                unchanged=unchanged,
            )
            return answer, scope_of(
                options,
                store.view(answer.run),
                wanted,
                root=root,
                store=store,
                configuration=configuration,
                unchanged=unchanged,
                fresh=answer.fresh,
            )

        wanted = _wanted(options, configuration, tags, root)
        options.each = (options.fix or options.diff) and bool(options.tools or configuration.source.tools.use)
        outcome, scope = look()
        refuse_unknown_tags(tags, scope.whole, configuration)
        if options.diff:
            return show_diff(options, root, configuration, scope)
        if options.fix:
            scope = fixed_scope(options, root, configuration, scope, lambda: look()[1])
        scope = _with_changes(gated(scope, configuration.gate), folder, options)
        write_outputs(chosen, options, scope.shown, scope.wanted)
        if folder is not None:
            _keep(folder, store, scope)
        if not options.quiet:
            _tell(scope, outcome, time.monotonic() - begun)
            _tell_interfaces(scope)
        code = _code(options, scope, missing)
    if options.watch:
        watch_files(options, root, configuration)
    return code


def _refuse_jobs(jobs: int | None) -> None:
    if jobs is not None and jobs < 0:
        from roslens.model.errors import UsageError

        raise UsageError(f"--jobs {jobs}", expected="0 (one per processor) or a positive number")


def _fetch(options: argparse.Namespace) -> int:
    """Fetch what is to be fetched first; return how many repositories could not be."""
    if options.fetch:
        return fetch_first(options)
    refuse_without_fetch(options)
    return 0


def _wanted(options: argparse.Namespace, configuration: Configuration, tags: TagFilter, root: Path) -> Wanted:
    from roslens.report.run.reported import Wanted

    return Wanted(
        tags,
        below_repository(root),
        options.fail_on or configuration.fail_on,
        configuration.accept_partial if options.accept_partial is None else options.accept_partial,
    )


def _store(folder: Path | None, configuration: Configuration, *, changed: bool) -> Store:
    """Open what the run is kept in: that of changed files is no whole run, and is kept apart on this machine."""
    if folder is not None and changed:
        from roslens.cli.workplace.own_store import open_own

        return open_own(folder / CHANGED_STORE)
    from roslens.cli.workplace.shared_store import store_for

    return store_for(None if folder is None else folder / STORE, configuration)


def _keep(folder: Path, store: Store, scope: Scope) -> None:
    """Keep which findings are new, or which files are meant, for commands that show the run later."""
    if scope.changed is not None:
        keep_changed_run(folder, store, scope.changed)
        return
    new = None if scope.wanted.new is None else new_first(scope.shown, scope.wanted)
    keep_new(folder, scope.whole.id, scope.wanted.baseline, new)


def _tell(scope: Scope, outcome: Answer, seconds: float) -> None:
    """Report details of the run besides the result."""
    tell_not_run(scope.whole.header)
    if outcome.left_out:
        print(f"roslens: {left_to_whole_run(outcome.left_out)}", file=sys.stderr)
    how = f"{outcome.measured} of {outcome.packages} packages measured" if outcome.fresh else "nothing changed"
    print(f"roslens: {how}, {seconds:.1f} s", file=sys.stderr)


def _tell_interfaces(scope: Scope) -> None:
    """Report what of messages, services and actions breaks since a baseline, and which nodes that affects."""
    found = None if scope.baseline is None else scope.baseline.interfaces
    if found is None or not found.breaking:
        return
    from roslens.cli.interfaces.users import with_users
    from roslens.report.run.interface_text import interface_lines

    found = with_users(found, [one.configuration for one in scope.whole.configurations()])
    for line in interface_lines(found):
        print(f"roslens: {line}", file=sys.stderr)


def _code(options: argparse.Namespace, scope: Scope, missing: int) -> int:
    """Return the exit code; a requested comparison that could not be made is reported."""
    if options.baseline and scope.baseline is None:
        # What was asked is not answered: that there are findings is not what the user wanted to know.
        print(f"roslens: nothing was compared with --baseline {options.baseline!r}; see the result", file=sys.stderr)
        return NOT_ANALYSED
    return _exit_code(scope.judged, scope.wanted) or (NOT_ANALYSED if missing else CLEAN)


def _with_changes(scope: Scope, folder: Path | None, options: argparse.Namespace) -> Scope:
    """Return a scope that knows what changed lately, where text shows it; ``--changed`` costs what the files cost."""
    import msgspec

    from roslens.cli.check.kept_changes import changes_of

    if options.changed is not None:
        return scope
    changes = changes_of(scope.whole, folder)
    return msgspec.structs.replace(scope, wanted=msgspec.structs.replace(scope.wanted, changes=changes))


def _exit_code(view: RunView, wanted: Wanted) -> int:
    from roslens.report.run.not_analysed import not_analysed

    if _fails(view, wanted) or any(one.holds is False for one in wanted.gate):
        return FINDINGS
    return NOT_ANALYSED if not_analysed(view, accept_partial=wanted.accept_partial) else CLEAN


def _fails(view: RunView, wanted: Wanted) -> bool:
    severities = [rule.severity for package in view.packages() for rule in package.rules if _counts(rule, wanted.tags)]
    severities += [finding.severity for finding in view.workspace.findings if _counts(finding, wanted.tags)]
    return any(map(wanted.fails, severities))


def _counts(broken: RuleCount | Finding, tags: TagFilter) -> bool:
    return bool(broken.gated) and tags.matches(broken.tags)
