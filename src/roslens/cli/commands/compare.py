"""``roslens compare``: two runs of a workspace, or two revisions, side by side."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from roslens.cli.completion_words import REVISIONS

if TYPE_CHECKING:
    from roslens.cli.named_run import NamedRun
    from roslens.compare.run_difference import RunDifference, RunSide

TEXT = "Compare two runs or revisions: findings that are new, resolved or moved, and what was measured."
EXAMPLES = """\
  roslens compare release now                what is different since the last release
  roslens compare v1.2.0 v1.3.0              two releases, analysed if they were not yet
  roslens compare 4 7                        two kept runs
  roslens compare origin/main now --format markdown -o comment.md
  roslens compare release now --fail-on error"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add both runs, and how the difference is written."""
    name = "number of a kept run, `now` (the newest), `release` (the last one), or a branch, tag or commit"
    for which, text in (("before", name), ("after", "the later one, named likewise")):
        parser.add_argument(which, metavar="RUN", help=text).complete = REVISIONS  # type: ignore[attr-defined]
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="the workspace (default: this folder)")
    parser.add_argument("--format", choices=("text", "markdown", "json"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write there instead of standard output")
    parser.add_argument(
        "--fail-on",
        choices=("note", "warning", "error", "never"),
        default="never",
        help="exit with 1 where a finding of this severity is new (default: never)",
    )
    parser.add_argument("--model", action="append", metavar="NAME", help="quality model for revisions, as for `check`")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")


def run(options: argparse.Namespace) -> int:
    """Write the difference and return the exit code.

    Raises:
        RoslensError: a name means no run, or a revision cannot be analysed.
    """
    import os

    from roslens.cli.analysed import settings_of
    from roslens.cli.boundary import CLEAN, FINDINGS
    from roslens.cli.configuration import find_configuration
    from roslens.cli.named_run import named_runs, workspace_root
    from roslens.cli.own_results import refuse_foreign
    from roslens.cli.streams import write_result
    from roslens.cli.workplace import FOLDER
    from roslens.compare.run_difference import run_difference
    from roslens.model.finding import Severity

    root = workspace_root(options.path)
    refuse_foreign(root / FOLDER, os.environ)
    settings = settings_of(options, find_configuration(root, options.config), os.environ)
    with named_runs(root, settings) as runs:
        before, after = runs.find(options.before), runs.find(options.after)
        found = run_difference(_side(before), _side(after), _renamed(str(root), before.commit, after.commit))
        text = _written(options.format, found, before, after)
    write_result(text, options.output)
    if options.fail_on == "never":
        return CLEAN
    least = Severity(options.fail_on).rank
    return FINDINGS if any(one.severity.rank >= least for one in found.findings.new) else CLEAN


def _side(one: NamedRun) -> RunSide:
    from roslens.compare.run_difference import RunSide

    header = one.view.header
    made_by = {**header.tools, "models": ", ".join(header.models)}
    return RunSide(tuple(one.view.findings()), one.view.packages(), made_by)


def _renamed(root: str, before: str, after: str) -> dict[str, str]:
    """Return files that git says were renamed; none where a run is of no known commit."""
    from roslens.cli.git_renames import renamed_files
    from roslens.cli.git_repository import repository_of
    from roslens.model.errors import UsageError

    if not before or not after:
        return {}
    try:
        return renamed_files(repository_of(root), before.rstrip("+"), after.rstrip("+"))
    except UsageError:
        return {}


def _written(form: str, found: RunDifference, before: NamedRun, after: NamedRun) -> str:
    from roslens.report.run_difference_text import difference_json, difference_lines, difference_markdown

    if form == "json":
        sides = [{"title": one.title, "commit": one.commit, "run": one.view.id} for one in (before, after)]
        return difference_json(found, *sides)
    write = difference_markdown if form == "markdown" else difference_lines
    return write(found, before.title, after.title)
