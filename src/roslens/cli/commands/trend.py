"""``roslens trend``: how a quantity went over the revisions that ``roslens history --every`` analysed."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from roslens.cli.completion_words import QUANTITIES
from roslens.model.errors import UsageError
from roslens.model.trend import Trend, TrendEvent

TEXT = "Show how a quantity developed over past revisions: a curve per package, with releases and changes of tools."
EXAMPLES = """\
  roslens trend loc                          after `roslens history --every release`
  roslens trend findings --package nav2_amcl
  roslens trend cyclomatic_complexity.max --since 2023-01-01
  roslens trend contributors --format csv -o contributors.csv
  roslens trend                              what can be followed"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is followed, and how it is written."""
    what = parser.add_argument(
        "quantity", nargs="?", metavar="QUANTITY", help="its key; without one, all keys are listed"
    )
    what.complete = QUANTITIES  # type: ignore[attr-defined]
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="the workspace (default: this folder)")
    parser.add_argument(
        "--package", action="append", default=[], metavar="NAME", help="only this package; may be given again"
    )
    parser.add_argument("--since", metavar="DATE", help="leave out revisions before this date, such as 2024-01-31")
    parser.add_argument("--format", choices=("text", "json", "csv"), default="text")
    parser.add_argument("-o", "--output", metavar="FILE", help="write to this file instead of standard output")
    parser.add_argument("--no-color", action="store_true", help="print no colours (as does NO_COLOR)")


def run(options: argparse.Namespace) -> int:
    """Write the trend.

    Raises:
        UsageError: no revisions were analysed, or what is asked for was never measured.
        StoreError: the runs cannot be read.
    """
    from roslens.cli.past.past_points import trends_of
    from roslens.cli.terminal.streams import write_result
    from roslens.cli.workplace.process_option import seconds_of
    from roslens.report.history.trend_tables import trend_json, trend_table

    with trends_of(options.path) as trends:
        if options.quantity is None:
            write_result("".join(f"{key}\n" for key in trends.keys), options.output)
            return 0
        _check(options.quantity, trends.keys)
        trend = trends.of(options.quantity)
        quantity = trends.quantities.get(options.quantity.partition(".")[0])
    _check_packages(options.package, trend)
    if options.package:
        trend = Trend(
            trend.quantity, trend.title, trend.unit, trend.whole_is, trend.points,
            {name: trend.packages[name] for name in options.package}, tuple(None for _ in trend.points), trend.events,
        )  # fmt: skip
    if options.since is not None:
        trend = _since(trend, seconds_of(options.since))
    if options.format == "json":
        write_result(trend_json(trend), options.output)
    elif options.format == "csv":
        from io import StringIO

        from roslens.report.writing.csv_table import write_rows

        stream = StringIO(newline="")
        write_rows(trend_table(trend), stream)
        write_result(stream.getvalue(), options.output)
    else:
        _write_text(options, trend, quantity.decimals if quantity else 0)
    return 0


def _write_text(options: argparse.Namespace, trend: Trend, decimals: int) -> None:
    from roslens.cli.terminal.streams import wants_color, width_of, write_result
    from roslens.report.history.trend_text import trend_text
    from roslens.report.writing.terminal import Terminal

    plain = options.output is not None
    unicode = plain or (sys.stdout.encoding or "").lower().replace("-", "").startswith("utf")
    terminal = Terminal(100 if plain else width_of(sys.stdout), not plain and wants_color(options, sys.stdout), unicode)
    values = [one for column in (trend.whole, *trend.packages.values()) for one in column if one is not None]
    digits = 0 if all(one == int(one) for one in values) else max(1, decimals)
    write_result(trend_text(trend, terminal, decimals=digits), options.output)


def _check(quantity: str, known: Sequence[str]) -> None:
    from difflib import get_close_matches

    if quantity not in known:
        near = get_close_matches(quantity, known, 3)
        raise UsageError(
            f'"{quantity}" was measured in no revision', expected="a key that `roslens trend` lists",
            advice=f"Did you mean {', '.join(near)}?" if near else "",
        )  # fmt: skip


def _check_packages(names: Sequence[str], trend: Trend) -> None:
    from difflib import get_close_matches

    for name in names:
        if name not in trend.packages:
            near = get_close_matches(name, trend.packages, 3)
            raise UsageError(
                f'--package "{name}" has no {trend.quantity} in any revision', expected="a package that has",
                advice=f"Did you mean {', '.join(near)}?" if near else "",
            )  # fmt: skip


def _since(trend: Trend, time_s: float) -> Trend:
    first = next((place for place, one in enumerate(trend.points) if one.time_s >= time_s), None)
    if first is None:
        raise UsageError("--since is after the last revision", expected="an earlier date")
    return Trend(
        trend.quantity, trend.title, trend.unit, trend.whole_is, trend.points[first:],
        {name: values[first:] for name, values in trend.packages.items()}, trend.whole[first:],
        tuple(TrendEvent(one.point - first, one.kind, one.text) for one in trend.events if one.point >= first),
        {name: values[first:] for name, values in trend.repositories.items()},
    )  # fmt: skip
