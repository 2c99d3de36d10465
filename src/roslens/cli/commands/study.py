"""``roslens study``: what was measured of many packages as distributions, correlations and tables."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError
from roslens.model.study import GROUPINGS

if TYPE_CHECKING:
    from roslens.judge.quality.quality_model import QualityModel
    from roslens.model.quantity import Quantity
    from roslens.model.study import Corpus

TEXT = "Summarise many packages: distributions and correlations of quantities, and which rules are broken."
EXAMPLES = """\
  roslens study                                  of the last run of this workspace
  roslens study --by role --format html -o study.html
  roslens study ~/ros1_ws ~/ros2_ws --by distribution    the last run of each, one beside the other
  roslens study --csv package_repo_metrics.csv --csv package_compliance.csv --by role
                                                 the tables of the 2016 study, from its raw data
  roslens study --csv mine.csv --format latex    a column `package`, and one for each quantity
  roslens study --format parquet -o all.parquet  every measurement, a row each"""

FORMATS = ("text", "html", "csv", "latex", "parquet")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is studied, how it is grouped, and how it is written."""
    parser.add_argument(
        "runs",
        nargs="*",
        metavar="RUN",
        help="folders that were checked, with /N behind one for another run than the last; or N, that run of this "
        "workspace (default: the last run of this workspace)",
    )
    parser.add_argument(
        "--csv",
        action="append",
        default=[],
        type=Path,
        metavar="FILE",
        help="a table instead of runs; may be given again for the table of rules",
    )
    parser.add_argument(
        "--by", choices=GROUPINGS, default="", help="group packages, and show the key figures of each group"
    )
    parser.add_argument(
        "--quantity",
        action="append",
        default=[],
        metavar="KEY",
        help="only these (default: sizes, findings and what the models limit)",
    )
    parser.add_argument(
        "--model",
        action="append",
        default=[],
        metavar="NAME",
        help="models whose limits are thresholds (default: those of the run)",
    )
    parser.add_argument("--format", choices=FORMATS, default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")


def run(options: argparse.Namespace) -> int:
    """Compute the study and write it.

    Raises:
        UsageError: what is given makes no sense, or a library of the extra ``study`` is missing.
        StoreError: a store cannot be read.
    """
    from roslens.cli.terminal.streams import write_result
    from roslens.report.study.study_text import study_csv, study_latex, study_text
    from roslens.source.study.measurements import write_measurements
    from roslens.source.study.study import study_of

    if options.csv and options.runs:
        raise UsageError("--csv and runs", expected="one of them")
    if options.format in ("html", "parquet") and not options.output:
        raise UsageError(f"--format {options.format}", expected="-o FILE, for it is nothing to read on a screen")
    corpus = _of_tables(options) if options.csv else _of_runs(options)
    if options.format == "parquet":
        write_measurements(corpus, Path(options.output))
        return 0
    study = study_of(corpus, options.by)
    if options.format == "html":
        from roslens.dashboard.study.page import study_page

        write_result(study_page(study), options.output)
        return 0
    write_result({"text": study_text, "csv": study_csv, "latex": study_latex}[options.format](study), options.output)
    return 0


def _of_tables(options: argparse.Namespace) -> Corpus:
    from roslens.source.study import paper_tables
    from roslens.source.study.csv_rows import read_csv
    from roslens.source.study.measured_table import corpus_of_table, is_measured_table

    tables = [read_csv(path) for path in options.csv]
    packages = [one for one in tables if paper_tables.is_package_table(one.head)]
    rules = [one for one in tables if paper_tables.is_rule_table(one.head)]
    own = [one for one in tables if is_measured_table(one.head)]
    if len(packages) == 1 and len(packages) + len(rules) == len(tables):
        return paper_tables.corpus_of(packages[0], rules)
    if len(own) == len(tables) == 1:
        known = _known()
        return corpus_of_table(own[0], known, _models(options.model or ["ros"], known))
    odd = next((one for one in tables if one not in packages and one not in rules), tables[-1])
    raise UsageError(
        f"the header begins with {', '.join(odd.head[:4])!r}",
        where=odd.path,
        expected="one table with a column `package`, or the tables of packages and of rules of the 2016 study",
    )


def _known() -> list[Quantity]:
    """Return what roslens measures itself, and what the study of 2016 measured."""
    from roslens.source.metrics.table import QUANTITIES
    from roslens.source.tools.cccc_quantities import CCCC_QUANTITIES

    return [*QUANTITIES.values(), *CCCC_QUANTITIES]


def _models(names: Sequence[str], known: Sequence[Quantity]) -> tuple[QualityModel, ...]:
    from roslens.source.chosen_models import chosen_models

    return chosen_models(names, Path.cwd(), {one.key: one for one in known})


def _of_runs(options: argparse.Namespace) -> Corpus:
    from roslens.cli.workplace.workplace import open_store
    from roslens.source.study.role import RolesInRuns
    from roslens.source.study.run_corpus import corpus_of_runs

    with ExitStack() as stack:
        runs = []
        for given in options.runs or ["."]:
            folder, number = _run(given)
            store = stack.enter_context(open_store(folder))
            name = Path(folder).resolve().name + (f"/{number}" if number is not None else "")
            runs.append((name, store.view(number)))
        names = options.model or sorted({name for _, view in runs for name in view.header.models})
        known = {one.key: one for _, view in runs for one in view.quantities()}
        models = _models(names, [*known.values(), *_known()])
        return corpus_of_runs(runs, models, RolesInRuns(), options.quantity)


def _run(given: str) -> tuple[str, int | None]:
    if given.isdigit() and not Path(given).exists():
        return ".", int(given)
    folder, slash, number = given.rpartition("/")
    if slash and number.isdigit() and not Path(given).exists():
        return folder or "/", int(number)
    return given, None
