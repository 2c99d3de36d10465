"""``--trust``: run what the configuration names, this once."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.cli.workplace.configuration import Configuration


def add_trust_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--trust``."""
    parser.add_argument(
        "--trust",
        action="store_true",
        help="run plug-ins, commands and tools that the configuration names, with their settings, without asking (see "
        "`roslens trust`)",
    )


def admitted_by(options: argparse.Namespace, configuration: Configuration, root: Path) -> Configuration:
    """Return the configuration with what the user lets run, asked on the terminal if need be.

    Where tools are used, it is also said whether they read their settings files in ``root``, the folder looked at.

    Raises:
        UsageError: what the user trusts cannot be read.
    """
    source = configuration.source
    found = configuration
    if (
        source.plugins
        or source.tools.commands
        or source.tools.use
        or source.options
        or source.models != ("ros",)
        or "://" in configuration.store + configuration.engine
    ):
        found = _admitted(options, configuration)
    given = getattr(options, "tools", None)
    if (given and given != ["none"]) or (not given and found.source.tools.use):
        return _with_settings_files(options, found, root)
    return found


def _admitted(options: argparse.Namespace, configuration: Configuration) -> Configuration:
    import os

    from roslens.cli.workplace.trust import admitted, asked_on_terminal, servers_of, switches_of

    quiet = bool(getattr(options, "quiet", False))
    given = bool(getattr(options, "trust", False))
    found = admitted(configuration, given=given, environment=os.environ, ask=asked_on_terminal(quiet=quiet))
    for server in sorted({*servers_of(configuration)} - {*servers_of(found)}):
        _tell(f"{server} of {configuration.path} is not used until `roslens trust`")
    for switch in sorted({*switches_of(configuration)} - {*switches_of(found)}):
        _tell(f"{switch} of {configuration.path} is not used until `roslens trust`")
    return found


def _with_settings_files(options: argparse.Namespace, configuration: Configuration, root: Path) -> Configuration:
    import os

    from roslens.cli.workplace.tool_settings import with_settings_files
    from roslens.cli.workplace.trust import asked_on_terminal

    return with_settings_files(
        configuration,
        given=bool(getattr(options, "trust", False)),
        environment=os.environ,
        root=root,
        ask=asked_on_terminal(quiet=bool(getattr(options, "quiet", False))),
        tell=_tell,
    )


def _tell(text: str) -> None:
    import sys

    print(f"roslens: {text}", file=sys.stderr)
