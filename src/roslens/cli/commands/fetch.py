"""``roslens fetch``: repositories of a distribution, taken into one folder."""

from __future__ import annotations

import argparse

from roslens.cli.check.fetch_options import add_fetch_arguments, fetched
from roslens.cli.terminal.boundary import CLEAN, NOT_ANALYSED
from roslens.cli.terminal.streams import add_stream_arguments, progress_for

TEXT = "Fetch the repositories of a distribution, or a selection of them, into one workspace."
EXAMPLES = """\
  roslens fetch --distro jazzy --package nav2_core --into nav2        the repository that has it
  roslens fetch --distribution robot.repos --into robot_ws/src        what `vcs import` reads
  roslens fetch --into robot_ws/src --update                          what the branches have now
  roslens fetch --distribution fetched.repos --into again             the same commits elsewhere
  roslens fetch --distribution indigo.yaml --filter robots.yaml --at count --into study
  roslens check --fetch --distro jazzy --repository navigation2       fetch, then check"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of ``roslens fetch``."""
    add_fetch_arguments(parser, "what and where")
    parser.add_argument("--jobs", type=int, default=0, metavar="N", help="repositories at once (default: 4)")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Fetch, print what became of each repository, and return the exit code.

    Raises:
        RoslensError: see :mod:`roslens.cli.terminal.boundary`.
    """
    import sys
    from pathlib import Path

    from roslens.cli.workplace.configuration import find_configuration
    from roslens.model.errors import UsageError
    from roslens.report.run.fetch_text import fetch_text
    from roslens.source.fetch.fetch_row import fetch_row

    if options.jobs < 0:
        raise UsageError(f"--jobs {options.jobs}", expected="0 (as configured) or a positive number")
    configuration = find_configuration(Path.cwd(), options.config)
    progress = progress_for(options)
    try:
        taken, failures = fetched(options, configuration, jobs=options.jobs, progress=progress)
    finally:
        progress.finish()
    rows = list(map(fetch_row, taken))
    sys.stdout.write(fetch_text(rows, failures, verbose=options.verbose, quiet=options.quiet))
    return NOT_ANALYSED if failures or any(one.failure for one in taken) else CLEAN
