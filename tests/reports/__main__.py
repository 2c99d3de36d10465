"""Scores the rebuilt reports and writes docs/reports.md: ``python -m reports``."""

from __future__ import annotations

import argparse
import subprocess
import sys
from collections.abc import Sequence

from reports.page import PAGE, page
from reports.recorded import LATEST, Table, keep
from reports.report_case import ROOT, ROUNDS, rebuilt
from reports.scoring import VERDICTS, Score, score


def main(words: Sequence[str] | None = None) -> int:
    """Do what the command line asks for, and return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m reports", description=__doc__)
    parser.add_argument(
        "cases", nargs="*", metavar="CASE", help="score these only and write nothing; a beginning will do"
    )
    parser.add_argument("--round", choices=ROUNDS, default=ROUNDS[0], help="which one to score (default: %(default)s)")
    parser.add_argument("--keep", action="store_true", help="keep the table under the name of the revision")
    parser.add_argument("--page", action="store_true", help="score nothing; write the page of what is recorded")
    options = parser.parse_args(words)
    if not options.page:
        chosen = [
            one
            for one in rebuilt(options.round)
            if not options.cases or any(one.name.startswith(case) for case in options.cases)
        ]
        if not chosen:
            sys.stderr.write(f"no case of round {options.round} begins with {' or '.join(options.cases)}\n")
            return 2
        scores = [score(one) for one in chosen]
        for one in scores:
            sys.stdout.write(_line(one))
        sys.stdout.write(_total(scores))
        if options.cases:
            return 0
        revision, date = _git("rev-parse", "--short=8", "HEAD"), _git("show", "-s", "--format=%cs", "HEAD")
        keep(options.round, revision if options.keep else LATEST, Table(revision, date, scores))
    PAGE.write_text(page(), "utf-8")
    sys.stdout.write(f"{PAGE}\n")
    return 0


def _line(one: Score) -> str:
    alarms = "".join(f"    false alarm: {alarm}\n" for alarm in one.alarms)
    return f"{one.name}: {one.verdict or 'correct form only'}{': ' + one.by if one.by else ''}\n{alarms}"


def _total(scores: Sequence[Score]) -> str:
    verdicts = [one.verdict for one in scores if one.verdict]
    counted = ", ".join(f"{verdicts.count(verdict)} {verdict}" for verdict in VERDICTS)
    alarmed = sum(bool(one.alarms) for one in scores)
    return f"{counted} of {len(verdicts)}; false alarms in {alarmed} of {len(scores)} correct forms\n"


def _git(*words: str) -> str:
    return subprocess.run(["git", "-C", str(ROOT), *words], check=True, capture_output=True, text=True).stdout.strip()


if __name__ == "__main__":
    sys.exit(main())
