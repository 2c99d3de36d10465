"""``roslens percentile``: where packages stand among ROS packages that many people know."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from roslens.cli.workplace.workplace import add_workspace_argument

if TYPE_CHECKING:
    from roslens.report.study.standings import Standing

TEXT = "Rank the packages of the last run among the ROS packages of many known repositories."
EXAMPLES = """\
  roslens percentile                             unusual values of each package: beyond nine of ten
  roslens percentile --package nav2_amcl         everything of one package
  roslens percentile --quantity loc --quantity cyclomatic_complexity
  roslens percentile --format csv -o standing.csv
  roslens check --model ros-2026                 functions and classes beyond nine of ten in the field"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the workspace, what of it, and how it is written."""
    add_workspace_argument(parser)
    parser.add_argument("--run", type=int, metavar="N", dest="number", help="a run other than the last")
    parser.add_argument("--package", action="append", default=[], metavar="NAME", help="only this one, with everything")
    parser.add_argument("--quantity", action="append", default=[], metavar="KEY", help="only this one")
    parser.add_argument("--all", action="store_true", help="show all values, not only unusual ones")
    parser.add_argument("--format", choices=("text", "csv", "json"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")


def run(options: argparse.Namespace) -> int:
    """Print the standings.

    Raises:
        UsageError: there is no run, no such package, or no such quantity.
        StoreError: the store cannot be read.
    """
    from roslens.cli.terminal.streams import write_result
    from roslens.cli.workplace.workplace import open_store
    from roslens.judge.quality.field import load_field
    from roslens.model.errors import UsageError
    from roslens.model.source import OUTSIDE_PACKAGES
    from roslens.report.study.standings import standings_csv, standings_json, standings_of, standings_text
    from roslens.source.study.role import RolesInRuns
    from roslens.source.study.run_corpus import language_of

    field = load_field()
    found: list[Standing] = []
    with open_store(options.path) as store:
        view = store.view(options.number)
        roles = RolesInRuns()
        packages = {one.id: one for one in view.packages() if one.id != OUTSIDE_PACKAGES}
        if unknown := [name for name in options.package if name not in packages]:
            raise UsageError(f'no package "{unknown[0]}" in this run', expected=f"one of {len(packages)} packages")
        quantities = view.quantities()
        known = {one.quantity for one in field.distributions}
        if unknown := [key for key in options.quantity if key not in known]:
            raise UsageError(
                f'no quantity "{unknown[0]}" in the field {field.name}', expected="a key such as loc or eloc.max"
            )
        for name in options.package or packages:
            groups = (f"role={roles(view, packages[name])}", f"language={language_of(packages[name])}")
            found.extend(standings_of(packages[name], quantities, field, groups))
    if options.quantity:
        found = [one for one in found if one.quantity in options.quantity]
    if options.format == "csv":
        write_result(standings_csv(found), options.output)
    elif options.format == "json":
        write_result(standings_json(found, field), options.output)
    else:
        complete = options.all or bool(options.package) or bool(options.quantity)
        write_result(standings_text(found, field, complete=complete), options.output)
    return 0
