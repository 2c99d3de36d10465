"""Draws samples and writes the page: ``python -m graph_findings sample FOLDER --seed N -o FILE`` and ``… page``."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path

from graph_findings.again import left_of, write_again
from graph_findings.collecting import GRAPH, NATIVE, NotReadError, findings_of, report_of
from graph_findings.judgements import NATIVE_TABLES, Sample, drawn, read, samples, taken_over, write
from graph_findings.page import MEASURED, PAGE, RULES_PAGE, measured, page, rules_page
from graph_findings.rates import RATES, rates_text
from graph_findings.repositories import repositories
from graph_findings.standing import enough

_SEVERITIES = ("note", "warning", "error")


def main() -> int:
    """Do what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m graph_findings", description=__doc__)
    verbs = parser.add_subparsers(required=True)
    sample = verbs.add_parser("sample", help="look at clones and draw findings to judge by hand")
    sample.add_argument("folder", type=Path, help="with clones, bare ones too: owner+name, owner__name or owner/name")
    sample.add_argument("--seed", type=int, required=True)
    sample.add_argument("--per-rule", type=int, default=20, metavar="N", help="at most so many of each rule")
    sample.add_argument("--per-repository", type=int, default=0, metavar="N", help="at most so many of a rule in one")
    sample.add_argument("--rule", action="append", default=[], metavar="ID", help="of these rules only")
    sample.add_argument("--whole", action="store_true", help="all of a rule of which there are at most --per-rule")
    sample.add_argument(
        "--spare", type=int, default=0, metavar="N", help="at most N of coding rules of which enough was read before"
    )
    sample.add_argument("--severity", choices=_SEVERITIES, default="warning", help="from this on (default: warning)")
    sample.add_argument("--developed", action="store_true", help="rules were changed because of these repositories")
    sample.add_argument("--native", action="store_true", help="coding rules instead of rules of the graph")
    sample.add_argument("--judged", type=Path, action="append", default=[], metavar="FILE", help="take verdicts over")
    sample.add_argument("-o", "--output", type=Path, required=True, metavar="FILE")
    sample.set_defaults(run=_sample)
    verbs.add_parser("page", help=f"write {PAGE.name}, {RULES_PAGE.name}, and what is known of rules").set_defaults(
        run=_page
    )
    again = verbs.add_parser("again", help="look which findings of a table on coding rules are still reported")
    again.add_argument("folder", type=Path, help="with the clones that the table was drawn of")
    again.add_argument("table", help="name of the table: held_out_one")
    again.set_defaults(run=_again)
    rates = verbs.add_parser("rates", help=f"write {RATES.name}: how often coding rules report in clones")
    rates.add_argument("folder", type=Path, help="with clones, as of sample")
    rates.set_defaults(run=_rates)
    options = parser.parse_args()
    code: int = options.run(options)
    return code


def _sample(options: argparse.Namespace) -> int:
    # What is wrong with them is told before hours are spent.
    judged = [read(path) for path in options.judged]
    found, commits, not_read = {}, {}, {}
    for one in repositories(options.folder):
        commits[one.name] = one.commit
        try:
            found[one.name] = findings_of(one, NATIVE if options.native else GRAPH)
        except NotReadError as error:
            not_read[one.name] = str(error)
        sys.stderr.write(f"{one.name}: {not_read.get(one.name) or len(found[one.name])}\n")
    if not commits:
        sys.stderr.write(f"{options.folder} has no clones: nothing was written\n")
        return 2
    wanted = _SEVERITIES[_SEVERITIES.index(options.severity) :]
    if options.rule:
        found = {name: [one for one in every if one["rule"] in options.rule] for name, every in found.items()}
    on = {name: [one for one in every if one["severity"] in wanted] for name, every in found.items()}
    spared = dict.fromkeys(enough(samples(NATIVE_TABLES)), options.spare) if options.spare else {}
    chosen = drawn(on, options.seed, options.per_rule, options.per_repository, whole=options.whole, spared=spared)
    rows = taken_over(chosen, commits, judged)
    counted = Counter(one["rule"] for every in on.values() for one in every)
    notes = Counter(one["rule"] for every in found.values() for one in every if one["severity"] not in wanted)
    write(
        Sample(
            options.developed, options.seed, options.per_rule, options.severity, commits, not_read,
            dict(sorted(counted.items())), dict(sorted(notes.items())), rows, options.per_repository,
            options.whole, spared, sorted(options.rule),
        ),
        options.output,
    )  # fmt: skip
    return 0


def _again(options: argparse.Namespace) -> int:
    table = NATIVE_TABLES / f"{options.table}.yaml"
    if not table.is_file():
        sys.stderr.write(f"{table} is no table\n")
        return 2
    sample, found = read(table), {}
    for one in repositories(options.folder):
        if one.name not in sample.repositories:
            continue
        if one.commit != sample.repositories[one.name]:
            sys.stderr.write(f"{one.name} is at {one.commit}; expected {sample.repositories[one.name]}\n")
            return 2
        found[one.name] = findings_of(one, NATIVE)
    if missing := sorted(set(sample.repositories) - set(found)):
        sys.stderr.write(f"not in {options.folder}: {', '.join(missing)}\n")
        return 2
    write_again(options.table, left_of(sample, found))
    return 0


def _rates(options: argparse.Namespace) -> int:
    RATES.write_text(rates_text(map(report_of, repositories(options.folder))), "utf-8")
    return 0


def _page(_options: argparse.Namespace) -> int:
    PAGE.write_text(page(samples()), "utf-8")
    native = samples(NATIVE_TABLES)
    RULES_PAGE.write_text(rules_page(native), "utf-8")
    MEASURED.write_text(measured(native, samples()), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
