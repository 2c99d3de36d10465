"""``roslens check``: analyse packages, keep the run, say what is wrong."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from roslens.cli.boundary import CLEAN, FINDINGS, NOT_ANALYSED
from roslens.cli.check_graph import add_graph_argument
from roslens.cli.streams import add_stream_arguments, progress_for, wants_color, width_of
from roslens.cli.trust_option import add_trust_argument, admitted_by
from roslens.cli.workplace import STORE, own_folder

if TYPE_CHECKING:
    from roslens.cli.configuration import Configuration
    from roslens.model.finding import Finding
    from roslens.model.result import RuleCount
    from roslens.model.tags import TagFilter
    from roslens.store.read import RunView

TEXT = "Measure and judge the packages below the given folders."
EXAMPLES = """\
  roslens check
  roslens check ~/robot_ws/src --model ros --model his
  roslens check --format json -o report.json
  roslens check --tag 'complexity and not test' --fail-on warning
  roslens check --graph                  also what does not fit together once the launch files are started"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of ``roslens check``."""
    parser.add_argument("paths", nargs="*", default=["."], metavar="PATH", help="folders to look into (default: .)")
    parser.add_argument("--format", choices=("text", "json", "csv"), default="text", help="of the result")
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="write the result there instead; a csv name without .csv is a folder for all tables",
    )
    parser.add_argument(
        "--model", action="append", metavar="NAME", help="quality model, built in or a file; may be given again"
    )
    parser.add_argument("--tag", metavar="EXPR", help="show only findings whose tags match, e.g. 'complexity and ros'")
    parser.add_argument(
        "--fail-on",
        choices=("note", "warning", "error", "never"),
        help="exit with 1 from this severity on (default: error)",
    )
    parser.add_argument(
        "--accept-partial",
        action="store_true",
        default=None,
        help="do not exit with 3 for files of which only parts could not be parsed",
    )
    parser.add_argument("--jobs", type=int, metavar="N", help="worker processes (default: one per processor)")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    parser.add_argument("--no-cache", action="store_true", help="read every file again")
    parser.add_argument("--no-store", action="store_true", help="keep nothing of this run")
    add_trust_argument(parser)
    add_graph_argument(parser)
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Analyse, print and return the exit code.

    Raises:
        RoslensError: see :mod:`roslens.cli.boundary`.
    """
    import os
    import time

    from roslens.cli.analysed import analysed
    from roslens.cli.configuration import find_configuration
    from roslens.model.errors import UsageError
    from roslens.model.tags import parse_tags
    from roslens.source.workspace.find import root_of
    from roslens.store.runs import Store

    begun = time.monotonic()
    tags = parse_tags(options.tag or "")
    if options.jobs is not None and options.jobs < 0:
        raise UsageError(f"--jobs {options.jobs}", expected="0 (one per processor) or a positive number")
    root = root_of(options.paths)
    configuration = admitted_by(options, find_configuration(root, options.config))
    with Store.open(None if options.no_store else own_folder(root) / STORE) as store:
        outcome = analysed(
            options,
            root,
            configuration,
            environment=dict(os.environ),
            store=store,
            progress=progress_for(options),
            begun=begun,
        )
        view = store.view(outcome.run)
        _write(options, view, tags)
        if not options.quiet:
            took = time.monotonic() - begun
            how = f"{outcome.measured} of {outcome.packages} packages measured" if outcome.fresh else "nothing changed"
            print(f"roslens: {how}, {took:.1f} s", file=sys.stderr)
        return _exit_code(options, configuration, view, tags)


def _write(options: argparse.Namespace, view: RunView, tags: TagFilter) -> None:
    if options.format == "csv" and options.output and not options.output.endswith(".csv"):
        from roslens.report.to_csv import write_folder

        write_folder(view, Path(options.output), tags)
        return
    if options.output:
        from roslens.report.whole_file import whole_file

        with whole_file(Path(options.output)) as stream:
            _write_to(options, view, tags, stream)
        return
    _write_to(options, view, tags, sys.stdout)


def _write_to(options: argparse.Namespace, view: RunView, tags: TagFilter, stream: TextIO) -> None:
    if options.format == "json":
        from roslens.report.to_json import write_json

        write_json(view, stream, tags)
    elif options.format == "csv":
        from roslens.report.to_csv import write_findings

        write_findings(view, stream, tags)
    else:
        from roslens.report.to_text import to_text

        stream.write(
            to_text(
                view.header,
                view.packages(),
                view.failures(),
                view.rules(),
                findings=view.workspace.findings,
                tags=tags,
                width=width_of(stream),
                color=wants_color(options, stream),
                unicode=(stream.encoding or "").lower().replace("-", "") == "utf8",
            )
        )


def _exit_code(options: argparse.Namespace, configuration: Configuration, view: RunView, tags: TagFilter) -> int:
    if _fails(options.fail_on or configuration.fail_on, view, tags):
        return FINDINGS
    accept = configuration.accept_partial if options.accept_partial is None else options.accept_partial
    return NOT_ANALYSED if _left_out(view, accept_partial=accept) else CLEAN


def _left_out(view: RunView, *, accept_partial: bool) -> bool:
    """Whether anything of what is judged was not analysed.

    What a manifest should say otherwise leaves nothing out, and a place that does not parse in code of others, in a
    test or in what was generated is none of what is judged.
    """
    from roslens.model.source import Role
    from roslens.source.workspace.manifest import MANIFEST

    failures = view.failures()
    if any(not failure.partial for failure in failures):
        return True
    open_ = [failure for failure in failures if failure.tool != MANIFEST]
    if accept_partial or not open_:
        return False
    own = {file.path for _, file in view.files() if file.role is Role.OWN}
    return any(
        failure.tool != "syntax" or failure.location is None or failure.location.path in own for failure in open_
    )


def _fails(fail_on: str, view: RunView, tags: TagFilter) -> bool:
    from roslens.model.finding import Severity

    if fail_on == "never":
        return False
    rank = Severity(fail_on).rank
    severities = [rule.severity for package in view.packages() for rule in package.rules if _counts(rule, tags)]
    severities += [finding.severity for finding in view.workspace.findings if _counts(finding, tags)]
    return any(severity.rank >= rank for severity in severities)


def _counts(broken: RuleCount | Finding, tags: TagFilter) -> bool:
    return bool(broken.gated) and tags.matches(broken.tags)
