"""``roslens trust``: let the plug-ins that a workspace names run, as they are now."""

from __future__ import annotations

import argparse
from pathlib import Path

TEXT = "Trust the plug-ins that a workspace's configuration names by path, with their current content."
EXAMPLES = """\
  roslens trust                     those of the nearest roslens.toml
  roslens trust ~/robot_ws/src --list    list what would run, and whether it is trusted
  roslens trust --revoke            trust them no more"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the workspace and what to do."""
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="whose roslens.toml counts (default: .)")
    parser.add_argument("--config", metavar="FILE", help="configuration (default: the nearest roslens.toml)")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--list", action="store_true", help="report what would run and whether it is trusted")
    what.add_argument("--revoke", action="store_true", help="stop trusting it")


def run(options: argparse.Namespace) -> int:
    """Trust, and report what was trusted.

    Raises:
        UsageError: what the user trusts cannot be read.
        DocumentError: the configuration is wrong.
    """
    import os

    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.trust import code_of, hash_of, is_trusted, revoke, trust

    configuration = find_configuration(Path(options.path).resolve(), options.config)
    where = configuration.path or f"{Path(options.path).resolve()} (no roslens.toml)"
    code = code_of(configuration)
    if options.revoke:
        print(f"{where}: {'no longer trusted' if revoke(configuration, os.environ) else 'was not trusted'}")
        return 0
    if not code:
        print(f"{where} names no plug-in by path and no command: nothing of it runs")
        return 0
    if options.list:
        state = "trusted" if is_trusted(configuration, os.environ) else "not trusted"
    else:
        trust(configuration, os.environ)
        state = "trusted from now on, until one of them changes"
    print(f"{where}: {state}")
    for name in code:
        print(f"  {name}")
    print(f"  sha256 {hash_of(configuration)}")
    return 0
