"""``roslens history --every``: past revisions of a workspace as runs."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.source.history.chosen_revisions import Every


def add_revision_arguments(parser: argparse.ArgumentParser) -> None:
    """Add ``--every`` and what goes with it."""
    group = parser.add_argument_group(
        "past revisions of source", "with --every, the place is the folder of a workspace (default: this one)"
    )
    group.add_argument(
        "--every",
        metavar="release|month|week|day|N",
        help="analyse past revisions: each release, the last commit of each month, or each N-th commit of the main "
        "line; then see `roslens trend` and `roslens compare`",
    )
    group.add_argument("--model", action="append", metavar="NAME", help="quality model, as for `roslens check`")
    group.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    group.add_argument("-q", "--quiet", action="store_true", help="print no progress")
    group.add_argument("-v", "--verbose", action="store_true", help="name each revision when it is done")


def every_of(text: str) -> Every:
    """Return what ``--every`` means.

    Raises:
        UsageError: it means nothing.
    """
    from roslens.source.history.chosen_revisions import PERIODS, Every

    try:
        return Every.parse(text)
    except ValueError as error:
        raise UsageError(
            f"--every: {error}", expected=f"{', '.join(PERIODS)} or a number of commits such as 10"
        ) from None


def analyse_past(options: argparse.Namespace, root: Path) -> int:
    """Analyse past revisions and say what was done; return the exit code.

    Raises:
        RoslensError: there is no history, or it cannot be kept.
    """
    import os
    from statistics import median

    from roslens.cli.check.analysed import settings_of
    from roslens.cli.past.past_runs import past_runs, since_of
    from roslens.cli.terminal.streams import progress_for
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.trust_option import admitted_by

    every = every_of(options.every)
    settings = settings_of(options, admitted_by(options, find_configuration(root, options.config), root), os.environ)
    progress = progress_for(options)
    with past_runs(root, settings) as runs:
        chosen = runs.states.chosen(every, since_s=since_of(options.since, runs.states))
        if not chosen:
            raise UsageError(f"no revision since {options.since}", expected="an earlier time")
        made = []
        progress.step("Analysing revisions", len(chosen))
        try:
            for state in chosen:
                made.append(runs.run_of(state))
                progress.advance(item=state.id[:10])
        finally:
            progress.finish()
        fresh = sorted(one.seconds for one in made if one.fresh)
        lacking = [failure for one in made if one.fresh for failure in runs.store.view(one.run).failures()]
        several = "" if runs.states.is_one else f" of {len(runs.states.repositories)} repositories together"
    if not options.quiet:
        took = f", {sum(fresh):.1f} s, median {median(fresh):.2f} s a revision" if fresh else ""
        print(f"roslens: {len(chosen)} revisions{several}, {len(fresh)} of them analysed now{took}", file=sys.stderr)
        if lacking:
            print(f"roslens: {len(lacking)} times something could not be analysed in part", file=sys.stderr)
        print("roslens: see them: roslens trend loc; roslens compare REVISION last; roslens serve", file=sys.stderr)
    return 0
