"""``roslens compare``: two runs or revisions; or what is expected against what is there."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from roslens.cli.completion_words import LAUNCHES, SIDES
from roslens.cli.terminal.streams import add_stream_arguments
from roslens.cli.watch.observers import add_observer_arguments

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.cli.past.named_run import NamedRun
    from roslens.compare.run_difference import RunDifference, RunSide
    from roslens.model.interfaces.interface_change import InterfaceDifference
    from roslens.source.settings import SourceSettings

TEXT = "Compare two runs or revisions; or source, a running system, recordings and references with each other."
EXAMPLES = """\
  roslens compare release now                differences since the last release
  roslens compare v1.2.0 v1.3.0              two releases, analysed if they were not yet
  roslens compare 4 7                        two kept runs
  roslens compare origin/main now --format markdown -o comment.md
  roslens compare release now --fail-on error

expected against actual, any two or three of source, what runs, a recording and a reference:
  roslens compare . live                     what source extracts against what runs here
  roslens compare . live --launch drive/drive.launch.xml --arg sim:=true
  roslens compare drive.launch.xml robot:8080          against what `roslens watch --serve` there sees
  roslens compare 3:drive.launch.xml drive.mcap        a graph that run 3 keeps against a recording
  roslens compare . live robot.yaml          and what a reference expects
  roslens compare robot.yaml live            reference against what runs
  roslens compare before.yaml live           a graph that `watch --graph-out` wrote against what runs

exit codes: as everywhere; of sides 1 where a difference is a warning or an error (--fail-on says otherwise)"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is compared, and how the difference is written."""
    run = "number of a kept run, `now` (the newest), `release` (the last one), or a branch, tag or commit"
    side = (
        "or a side: a workspace, a launch file, N:CONFIGURATION of a run, `live`, HOST:PORT of a monitor, a recording, "
        "a reference, a graph that was written"
    )
    for which, text in (("before", f"{run}; {side}"), ("after", "the second, named likewise")):
        parser.add_argument(which, metavar="A" if which == "before" else "B", help=text).complete = SIDES  # type: ignore[attr-defined]
    parser.add_argument(
        "path", nargs="?", metavar="C", help="a third side; of runs the workspace (default: this folder)"
    ).complete = SIDES  # type: ignore[attr-defined]
    parser.add_argument("--format", choices=("text", "markdown", "json"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")
    parser.add_argument(
        "--fail-on",
        choices=("note", "warning", "error", "never"),
        help="exit with 1 where a finding of this severity is new (default: never), or where sides differ so gravely "
        "(default: warning)",
    )
    parser.add_argument("--model", action="append", metavar="NAME", help="quality model for revisions, as for `check`")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    sides = parser.add_argument_group("of sides")
    sides.add_argument(
        "--launch", metavar="FILE", help="what of the workspace is compared (default: what fits the other side best)"
    ).complete = LAUNCHES  # type: ignore[attr-defined]
    sides.add_argument("--arg", action="append", default=[], metavar="NAME:=VALUE", help="argument of the launch file")
    sides.add_argument(
        "--workspace", default=".", metavar="DIR", help="where launch files and kept runs are (default: this folder)"
    )
    sides.add_argument("--notes", action="store_true", help="also report what matches or cannot be decided")
    sides.add_argument(
        "--for",
        dest="length",
        metavar="TIME",
        help="observe the running system for this time (default: until nothing changes)",
    )
    sides.add_argument("--jobs", type=int, metavar="N", help="worker processes (default: one per processor)")
    sides.add_argument("--no-cache", action="store_true", help="read every file again, and keep nothing")
    add_observer_arguments(parser.add_argument_group("of what runs"))
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Write the difference and return the exit code.

    Raises:
        RoslensError: a name means no run and no side, or one of them cannot be read.
    """
    from roslens.cli.conformance.compare_sides import compare_sides, names_sides

    words = [word for word in (options.before, options.after, options.path) if word is not None]
    if names_sides(words, options.launch):
        return compare_sides(words, options)
    return _of_runs(options)


def _of_runs(options: argparse.Namespace) -> int:
    import os

    from roslens.cli.check.analysed import settings_of
    from roslens.cli.git.renamed_between import renamed_between
    from roslens.cli.past.named_run import named_runs
    from roslens.cli.past.past_store import workspace_root
    from roslens.cli.terminal.boundary import CLEAN, FINDINGS
    from roslens.cli.terminal.streams import write_result
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.trust_option import admitted_by
    from roslens.compare.run_difference import run_difference
    from roslens.model.finding import Severity

    root = workspace_root(options.path or ".")
    settings = settings_of(options, admitted_by(options, find_configuration(root, options.config), root), os.environ)
    with named_runs(root, settings) as runs:
        before, after = runs.find(options.before), runs.find(options.after)
        found = run_difference(_side(before), _side(after), renamed_between(root, before.commits, after.commits))
        interfaces = _interfaces(root, settings, (options.before, options.after), (before, after))
        text = _written(options.format, found, before, after, interfaces)
    write_result(text, options.output)
    if options.fail_on in (None, "never"):
        return CLEAN
    least = Severity(options.fail_on).rank
    # A change that breaks may be meant, so that it counts as a warning.
    breaks = interfaces is not None and bool(interfaces.breaking) and Severity.WARNING.rank >= least
    return FINDINGS if breaks or any(one.severity.rank >= least for one in found.findings.new) else CLEAN


def _interfaces(
    root: Path, settings: SourceSettings, names: tuple[str, str], runs: tuple[NamedRun, NamedRun]
) -> InterfaceDifference | None:
    """Return how interfaces differ, with the nodes that are affected; None where the files of a run are not known."""
    from roslens.cli.interfaces.states import state_of_revision, state_of_tree
    from roslens.cli.interfaces.users import with_users
    from roslens.cli.past.named_run import NOW
    from roslens.source.extract.workspace.interface_state import interface_difference

    if not all(one.commit for one in runs) or len(runs[1].commits) != 1:
        return None
    before, after = (
        state_of_tree(root, settings)
        if name in NOW
        else state_of_revision(root, one.commit.removesuffix("+"), settings)
        for name, one in zip(names, runs, strict=True)
    )
    found = interface_difference(before, after)
    return with_users(found, [one.configuration for one in runs[1].view.configurations()])


def _side(one: NamedRun) -> RunSide:
    from roslens.compare.run_difference import RunSide

    header = one.view.header
    made_by = {**header.tools, "models": ", ".join(header.models)}
    return RunSide(tuple(one.view.findings()), one.view.packages(), made_by)


def _written(
    form: str, found: RunDifference, before: NamedRun, after: NamedRun, interfaces: InterfaceDifference | None
) -> str:
    from roslens.report.run.interface_text import interface_document, interface_lines, interface_markdown
    from roslens.report.run.run_difference_text import difference_json, difference_lines, difference_markdown

    if form == "json":
        sides = [{"title": one.title, "commit": one.commit, "run": one.view.id} for one in (before, after)]
        return difference_json(
            found, sides[0], sides[1], None if interfaces is None else interface_document(interfaces)
        )
    changed = interfaces if interfaces is not None and interfaces.changes else None
    if form == "markdown":
        text = difference_markdown(found, before.title, after.title)
        return text if changed is None else f"{text}\n{interface_markdown(changed)}"
    text = difference_lines(found, before.title, after.title)
    return text if changed is None else text + "".join(f"{line}\n" for line in interface_lines(changed))
