"""``roslens check --fetch``: what is checked is fetched first."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from roslens.cli.check.fetch_options import fetched
from roslens.cli.terminal.streams import progress_for
from roslens.model.errors import UsageError


def fetch_first(options: argparse.Namespace) -> int:
    """Fetch by the options of ``roslens check``, check the result, and return how much could not be fetched.

    What became of repositories goes to standard error, as standard output is the report's.

    Raises:
        UsageError: an option or a document is wrong, or folders are given beside.
    """
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.report.run.fetch_text import fetch_text
    from roslens.source.fetch.fetch_row import fetch_row

    if options.paths != ["."]:
        raise UsageError(
            f'--fetch and the folder "{options.paths[0]}"',
            expected="one of them: with --fetch, the fetched folder is checked",
            advice="--into DIR, the target folder",
        )
    progress = progress_for(options)
    try:
        taken, failures = fetched(options, find_configuration(Path.cwd(), options.config), jobs=0, progress=progress)
    finally:
        progress.finish()
    text = fetch_text(list(map(fetch_row, taken)), failures, verbose=options.verbose, quiet=options.quiet)
    sys.stderr.write(text)
    options.paths = [options.into or "."]
    return len(failures) + sum(bool(one.failure) for one in taken)
