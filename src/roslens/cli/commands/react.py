"""``roslens react``: what is done about what does not hold."""

from __future__ import annotations

import argparse

from roslens.cli import react_simulate

TEXT = "Say what would be done about what references say does not hold."
EXAMPLES = react_simulate.EXAMPLES


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the references and what is simulated."""
    parser.add_argument(
        "files", nargs="+", metavar="FILE", help="references with reactions, later ones taking precedence"
    )
    react_simulate.add_arguments(parser)
    parser.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    """Do what is asked for and return the exit code.

    Raises:
        DocumentError: a document is wrong.
        UsageError: nothing is to be simulated.
    """
    from roslens.model.errors import UsageError

    if not options.simulate:
        raise UsageError("react without --simulate", expected="--simulate with --bag or --timeline")
    return react_simulate.simulate(options.files, bag=options.bag, timeline=options.timeline, as_json=options.json)
