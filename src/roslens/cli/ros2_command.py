"""``ros2 lens``: every command of roslens behind ``ros2``; only ros2cli imports this."""

from __future__ import annotations

import argparse
from typing import Any

from ros2cli.command import CommandExtension

from roslens.cli.main import main


class LensCommand(CommandExtension):  # type: ignore[misc]
    """Quality of packages and health of running systems (roslens)."""

    def add_arguments(self, parser: argparse.ArgumentParser, cli_name: str, **_: Any) -> None:
        """Take all that follows as it is."""
        parser.add_argument(
            "arguments",
            nargs=argparse.REMAINDER,
            metavar="COMMAND …",
            help=f"a command of roslens and its options: `{cli_name} check`, `{cli_name} watch --help`",
        )

    def main(self, *, parser: argparse.ArgumentParser, args: argparse.Namespace) -> int:  # noqa: ARG002 - ros2cli's signature
        """Run the command."""
        return main(args.arguments or ["--help"])
