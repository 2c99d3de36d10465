"""``--trust``: run the plug-ins and commands that the configuration names, this once."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.workplace.configuration import Configuration


def add_trust_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--trust``."""
    parser.add_argument(
        "--trust",
        action="store_true",
        help="run plug-ins and commands that the configuration names, without asking (see `roslens trust`)",
    )


def admitted_by(options: argparse.Namespace, configuration: Configuration) -> Configuration:
    """Return the configuration with the plug-ins that the user lets run, asked on the terminal if need be.

    Raises:
        UsageError: what the user trusts cannot be read.
    """
    import os
    import sys

    if not (
        configuration.source.plugins
        or configuration.source.tools.commands
        or "://" in configuration.store + configuration.engine
    ):
        return configuration
    from roslens.cli.workplace.trust import admitted, asked_on_terminal, servers_of

    quiet = bool(getattr(options, "quiet", False))
    given = bool(getattr(options, "trust", False))
    found = admitted(configuration, given=given, environment=os.environ, ask=asked_on_terminal(quiet=quiet))
    for server in sorted({*servers_of(configuration)} - {*servers_of(found)}):
        print(f"roslens: {server} of {configuration.path} is not used until `roslens trust`", file=sys.stderr)
    return found
