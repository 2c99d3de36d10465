"""``roslens report``: the pages of the last run as files."""

from __future__ import annotations

import argparse
from pathlib import Path

from roslens.cli.check.analysed import add_kept_arguments
from roslens.cli.graph.shown_graphs import add_shown_argument
from roslens.cli.terminal.streams import add_stream_arguments, progress_for
from roslens.cli.workplace.workplace import add_workspace_argument
from roslens.model.errors import UsageError

TEXT = "Write the pages of the last run as a folder or as one HTML file."
EXAMPLES = """\
  roslens report -o report               then open report/index.html
  roslens report --single-file robot.html   one file, to mail or archive"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the workspace and where to write."""
    add_workspace_argument(parser)
    where = parser.add_mutually_exclusive_group()
    where.add_argument("-o", "--output", metavar="DIR", default="roslens-report", help="folder (default: %(default)s)")
    where.add_argument("--single-file", metavar="FILE", help="one self-contained HTML file")
    parser.add_argument("--jobs", type=int, metavar="N", help="processes that write pages (default: one per processor)")
    parser.add_argument("--run", type=int, metavar="N", dest="number", help="a run other than the last")
    add_shown_argument(parser)
    add_kept_arguments(parser)
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Write the files and print their paths.

    Raises:
        UsageError: there is no run, the number of processes is none, or the folder holds something else.
        StoreError: the store cannot be read.
    """
    from roslens.cli.check.kept_changes import shown_changes
    from roslens.cli.check.kept_new import shown_new
    from roslens.cli.check.shown_run import shown_run
    from roslens.cli.graph.shown_graphs import site_with_graphs
    from roslens.cli.past.shown_past import shown_past

    if options.jobs is not None and options.jobs < 0:
        raise UsageError(f"--jobs {options.jobs}", expected="0 (one per processor) or a positive number")
    progress = progress_for(options)
    with shown_run(options, progress) as view, shown_past(options, view) as past:
        site = site_with_graphs(view, options, progress)
        site.past = past
        site.new_first = shown_new(options, view)
        site.changes = shown_changes(options, view)
        try:
            if options.single_file:
                from roslens.dashboard.single_file import single_file

                single_file(site, Path(options.single_file))
                written = options.single_file
            else:
                from roslens.dashboard.export import export_folder

                export_folder(site, Path(options.output), progress, options.jobs or 0)
                written = str(Path(options.output, "index.html"))
        finally:
            progress.finish()
    print(written)
    return 0
