"""``roslens reference export``: what Prometheus, Alertmanager, Grafana and Foxglove get of a reference."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.terminal.boundary import CLEAN

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference

TEXT = (
    "Export references: rules for Prometheus, routes for Alertmanager, a dashboard for Grafana, a layout for Foxglove."
)
EXAMPLES = """\
  roslens reference export rover.yaml --prometheus -o rover.rules.yml      promtool check rules rover.rules.yml
  roslens reference export rover.yaml --alertmanager -o alertmanager.yml   amtool check-config alertmanager.yml
  roslens reference export rover.yaml --grafana -o rover.json              import it as a dashboard
  roslens reference export rover.yaml --foxglove -o rover.json             import it as a layout"""
RATED = "/roslens/rated"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is exported, and for whom."""
    parser.add_argument("files", nargs="+", metavar="FILE", help="references, later ones taking precedence")
    form = parser.add_mutually_exclusive_group(required=True)
    for name, text in (
        ("prometheus", "alerting rules of Prometheus"),
        ("alertmanager", "routes of Alertmanager: first causes are reported, what follows from them is not"),
        ("grafana", "a dashboard of Grafana"),
        ("foxglove", "a layout of Foxglove or Lichtblick"),
    ):
        form.add_argument(f"--{name}", dest="form", action="store_const", const=name, help=text)
    parser.add_argument(
        "--rated", metavar="TOPIC", default=RATED,
        help=f"where `roslens watch --publish-statistics` publishes, for --foxglove (default: {RATED})",
    )  # fmt: skip
    parser.add_argument("-o", "--output", metavar="FILE", help="write it to this file (default: standard output)")
    parser.add_argument("-q", "--quiet", action="store_true", help="do not report omitted constraints")
    parser.set_defaults(act=export)


def export(options: argparse.Namespace) -> int:
    """Write it, report what is left out, and return the exit code.

    Raises:
        DocumentError: a reference is wrong.
        OSError: the file cannot be written.
    """
    from roslens.cli.terminal.streams import write_result
    from roslens.judge.reading.read_reference import load_reference
    from roslens.live.window.signals import BY_KEY

    reference = load_reference([Path(file) for file in options.files], BY_KEY)
    text, left = _made(reference, options)
    write_result(text, options.output)
    for line in () if options.quiet else left:
        print(f"roslens: {line}", file=sys.stderr)
    return CLEAN


def _made(reference: Reference, options: argparse.Namespace) -> tuple[str, tuple[str, ...]]:
    if options.form == "prometheus":
        from roslens.live.publish.exported.prometheus_rules import prometheus_rules

        return prometheus_rules(reference), ()
    if options.form == "alertmanager":
        from roslens.live.publish.exported.alertmanager_config import alertmanager_config

        return alertmanager_config(reference), ()
    if options.form == "grafana":
        from roslens.live.publish.exported.grafana_dashboard import grafana_dashboard

        return grafana_dashboard(reference)
    from roslens.live.publish.exported.foxglove_layout import foxglove_layout

    return foxglove_layout(reference, options.rated)
