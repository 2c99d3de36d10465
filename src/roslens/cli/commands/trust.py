"""``roslens trust``: let what a workspace configures run, as it is now."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from roslens.cli.workplace.configuration import Configuration

TEXT = "Trust the plug-ins, commands and tools of a workspace's configuration, and settings of tools, as they are now."
EXAMPLES = """\
  roslens trust                     what the nearest roslens.toml names
  roslens trust ~/robot_ws/src --list    list what would run, and whether it is trusted
  roslens trust --revoke            trust it no more"""


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
    from roslens.cli.workplace.tool_settings import settings_files, trust_settings
    from roslens.cli.workplace.trust import code_of, hash_of, place_of, revoke, trust

    root = Path(options.path).resolve()
    configuration = find_configuration(root, options.config)
    where = configuration.path or f"{root} (no roslens.toml)"
    if options.revoke:
        print(f"{where}: {'no longer trusted' if revoke(configuration, os.environ, root) else 'was not trusted'}")
        return 0
    code, files = code_of(configuration), settings_files(place_of(configuration, root))
    if not (code or files):
        print(f"{where} names no program, and there are no settings files of tools: nothing of it runs")
        return 0
    if options.list:
        state = "trusted" if _is_trusted(configuration, code, files, root) else "not trusted"
    else:
        if code:
            trust(configuration, os.environ)
        trust_settings(configuration, os.environ, root)
        state = "trusted from now on, until one of them changes"
    print(f"{where}: {state}")
    for name in (*code, *files):
        print(f"  {name}")
    if code:
        print(f"  sha256 {hash_of(configuration)}")
    return 0


def _is_trusted(configuration: Configuration, code: Sequence[str], files: tuple[str, ...], root: Path) -> bool:
    """Return whether everything that would run, and settings that tools would read, is trusted as it is now."""
    import os

    from roslens.cli.workplace.tool_settings import hash_of_settings
    from roslens.cli.workplace.trust import is_trusted, place_of, read_trusted

    if code and not is_trusted(configuration, os.environ):
        return False
    return not files or read_trusted(os.environ).settings.get(place_of(configuration, root)) == hash_of_settings(files)
